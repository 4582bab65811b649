// Models in words: their sides, titles and explanations.
#include <algorithm>
#include <set>

#include "engine/base/text.h"
#include "engine/query/describe.h"
#include "engine/query/parts.h"
#include "engine/query/words.h"

namespace aerascope {
namespace {

using Names = std::vector<std::string>;

std::string SideText(const KnowledgeBase& knowledge, bool positive, const Term& payload, const Names& names,
                     Writing writing = Writing::kAsGiven) {
  return (positive ? "" : "not ") + PayloadWords(knowledge, payload, names, writing);
}

std::string MakesText(const KnowledgeBase& knowledge, const InstanceSides& sides,
                      Writing writing = Writing::kAsGiven) {
  return SideText(knowledge, sides.lhs_positive, sides.lhs, sides.names, writing) +
         (sides.rhs_positive ? " makes " : " ends ") +
         PayloadWords(knowledge, sides.rhs, sides.rhs_names, writing);
}

std::string Article(const std::string& phrase) {
  return phrase.find_first_of("aeiouAEIOU") == 0 ? "an " + phrase : "a " + phrase;
}

// What is said of one thing by constants: kinds as nouns ("cube"), places ("at table"), the rest as
// adjectives
// ("large").
struct Description {
  std::set<std::string> adjectives;
  std::set<std::string> nouns;
  std::set<std::string> places;

  bool empty() const { return adjectives.empty() && nouns.empty() && places.empty(); }
  std::string Words() const {
    std::vector<std::string> words(adjectives.begin(), adjectives.end());
    words.insert(words.end(), nouns.begin(), nouns.end());
    words.insert(words.end(), places.begin(), places.end());
    return Join(words, " ");
  }
  // "a large cube", "something large".
  std::string Text() const { return nouns.empty() ? "something " + Words() : Article(Words()); }
};

Description DescriptionOf(const Term& thing, const Parts& parts) {
  Description description;
  for (const Part& part : parts.parts) {
    if (!part.positive || !IsValue(part.payload) || !(part.payload[0] == thing)) continue;
    if (!part.payload[2].is(TermKind::kOntology)) continue;
    const std::string& attribute = part.payload[1].name();
    const std::string value = Printable(part.payload[2].name());
    if (NamesAKind(attribute)) {
      description.nouns.insert(value);
    } else if (NamesAPlace(attribute)) {
      description.places.insert("at " + value);
    } else {
      description.adjectives.insert(value);
    }
  }
  return description;
}

// "S at P whenever move [H D] makes H at P".
std::string ReuseTitle(const KnowledgeBase& knowledge, const Model& model) {
  const ModelLines lines = LinesOf(knowledge, model);
  return lines.rhs + " whenever " + lines.lhs;
}

// Where a model does not start from a command: what it starts from, and the things that the requirement is
// about.
std::string SettingTitle(const KnowledgeBase& knowledge, const Model& requirement, const Model& target) {
  std::string title =
      KindOf(target) == ModelKind::kReuse
          ? ReuseTitle(knowledge, target)
          : SideText(knowledge, target.lhs.positive, target.lhs.payload, VariableNames(knowledge, target));
  Parts parts;
  AddParts(knowledge, requirement.lhs, 0, &parts);
  std::set<std::string> things;
  for (const Part& part : parts.parts) {
    if (!IsValue(part.payload)) continue;
    const Description description = DescriptionOf(part.payload[0], parts);
    if (!description.empty()) things.insert(description.Text());
  }
  return things.empty() ? title : title + ", with " + InWords({things.begin(), things.end()});
}

// "grab_type_2 something large": the command, and the things it is about that it does not name itself; the
// things it does name only if there are no others.
std::string ActionTitle(const KnowledgeBase& knowledge, const Model& requirement, const Model& target) {
  std::vector<Term> arguments;
  ArgumentsOf(target, requirement.rhs.payload, &arguments);
  if (!IsCommand(target.lhs.payload)) return SettingTitle(knowledge, requirement, target);
  const Term command = WithArguments(target.lhs.payload, arguments);
  if (!IsCommand(command)) return ValueText(target.lhs.payload[0]);
  Parts parts;
  AddParts(knowledge, requirement.lhs, 0, &parts);
  std::vector<Term> named;
  ForEachTerm(command[1], [&](const Term& term) {
    if (term.is(TermKind::kVariable)) named.push_back(term);
  });
  const auto is_named = [&](const Term& thing) {
    return std::find(named.begin(), named.end(), thing) != named.end();
  };

  std::set<std::string> others;
  std::set<std::string> by_name;
  for (const Part& part : parts.parts) {
    if (!IsValue(part.payload)) continue;
    const Description description = DescriptionOf(part.payload[0], parts);
    if (description.empty()) continue;
    if (!is_named(part.payload[0]))
      others.insert(description.Text());
    else
      by_name.insert(description.nouns.empty() ? description.Text() : "the " + description.Words());
  }
  const std::set<std::string>& phrases = others.empty() ? by_name : others;
  std::string title = ValueText(target.lhs.payload[0]);
  if (!phrases.empty()) title += " " + InWords({phrases.begin(), phrases.end()});
  return title;
}

std::string Sentence(const std::string& text) {
  return text + ".";
}

// A delay as people say it, behind a title and in front of a conclusion; nothing where there is none.
std::string Earlier(const Model& model) {
  const Duration delay = DelayOf(model).value_or(Duration{});
  return delay.us > 0 ? ", seen " + SecondsText(Time{delay.us}) + " before" : "";
}
std::string Later(const Model& model) {
  const Duration delay = DelayOf(model).value_or(Duration{});
  return delay.us > 0 ? SecondsText(Time{delay.us}) + " later " : "";
}

// Adds the names of a term's variables, each once.
void NoteVariables(const Term& term, const Names& names, std::vector<std::string>* noted) {
  ForEachVariable(term, [&](int v) {
    if (static_cast<std::size_t>(v) >= names.size()) return;
    const std::string& name = names[static_cast<std::size_t>(v)];
    if (std::find(noted->begin(), noted->end(), name) == noted->end()) noted->push_back(name);
  });
}

const ModelRecord* RecordOfInstance(const KnowledgeBase& knowledge, const Term& imdl) {
  return IsImdl(imdl) && imdl[0].is(TermKind::kModel) ? knowledge.Find(imdl[0].model()) : nullptr;
}

// What the variables of a model stand for in an instance of it. What the instance leaves open is numbered
// behind the instance's own variables, with the model's names for it.
struct OpenedArguments {
  std::vector<Term> arguments;
  std::vector<bool> open;
  Names names;
};
OpenedArguments ArgumentsWithOpen(const KnowledgeBase& knowledge, const Model& model, const Term& imdl,
                                  const Names& names) {
  OpenedArguments opened;
  ArgumentsOf(model, imdl, &opened.arguments);
  const Names own = VariableNames(knowledge, model);
  std::size_t outer = names.size();
  ForEachVariable(imdl, [&](int v) { outer = std::max(outer, static_cast<std::size_t>(v) + 1); });
  opened.names = names;
  opened.names.resize(outer);
  for (std::size_t v = 0; v < opened.arguments.size(); ++v) {
    Term& argument = opened.arguments[v];
    opened.open.push_back(argument.is(TermKind::kWildcard) ||
                          (names.empty() && argument.is(TermKind::kVariable)));
    if (opened.open[v]) argument = Term::Variable(static_cast<int>(outer + v));
    std::string name = opened.open[v] ? own[v] : "";
    while (!name.empty() && std::find(opened.names.begin(), opened.names.end(), name) != opened.names.end())
      name += "'";
    opened.names.push_back(std::move(name));
  }
  return opened;
}

}  // namespace

std::optional<Duration> DelayOf(const Model& model) {
  if (!IsRequirement(model) || !model.lhs.after.is(TermKind::kVariable) ||
      !model.rhs.after.is(TermKind::kVariable)) {
    return std::nullopt;
  }
  if (model.lhs.after == model.rhs.after) return Duration{};
  for (const Guard& guard : model.forward) {
    const Term& sum = guard.expression;
    if (guard.target == model.rhs.after.variable() && sum.IsStruct("+") && sum.size() == 2 &&
        sum[0] == model.lhs.after && sum[1].is(TermKind::kDuration)) {
      return sum[1].duration();
    }
  }
  return std::nullopt;
}

std::vector<std::string> NamesLikeItsState(const KnowledgeBase& knowledge, const Model& requirement) {
  Names names(VariableCount(requirement));
  const CompositeStateRecord* state = knowledge.Find(RequiredState(requirement));
  std::vector<Term> arguments;
  if (state && ArgumentsOf(state->state, requirement.lhs.payload, &arguments)) {
    const Names of_state = VariableNames(knowledge, state->state);
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      if (!arguments[i].is(TermKind::kVariable)) continue;
      std::string& name = names[static_cast<std::size_t>(arguments[i].variable())];
      if (name.empty()) name = of_state[i];
    }
  }
  const Names own = VariableNames(knowledge, requirement);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!names[i].empty()) continue;
    names[i] = own[i];
    while (std::count(names.begin(), names.end(), names[i]) > 1) names[i] += "'";
  }
  return names;
}

std::optional<InstanceSides> SidesOfInstance(const KnowledgeBase& knowledge, const Term& imdl,
                                             const std::vector<std::string>& names) {
  const ModelRecord* record = RecordOfInstance(knowledge, imdl);
  if (!record) return std::nullopt;
  const Model& model = record->model;
  const OpenedArguments opened = ArgumentsWithOpen(knowledge, model, imdl, names);
  InstanceSides sides{model.lhs.positive, model.rhs.positive, {}, {}, opened.names, opened.names};
  sides.lhs = WithArguments(model.lhs.payload, opened.arguments);
  // Where the instance leaves the effect open, its formula says more than a name.
  sides.rhs = WithArguments(model.rhs.payload, opened.arguments);
  if (!sides.rhs.ground()) sides.rhs = WithArguments(RightSide(model), opened.arguments);
  WriteFormulas(knowledge, sides.lhs, &sides.rhs, &sides.rhs_names);
  return sides;
}

void WriteFormulas(const KnowledgeBase& knowledge, const Term& lhs, Term* rhs, Names* names) {
  constexpr int kDeepestFormula = 8;
  const ModelRecord* record = RecordOfInstance(knowledge, lhs);
  if (!record) return;
  const OpenedArguments opened = ArgumentsWithOpen(knowledge, record->model, lhs, *names);
  bool wrote = false;
  for (const Guard& guard : record->model.forward) {
    if (!guard.target) continue;
    const auto target = static_cast<std::size_t>(*guard.target);
    if (opened.open[target] || !opened.arguments[target].is(TermKind::kVariable)) continue;
    const Term formula = WithArguments(guard.expression, opened.arguments);
    if (formula.depth() > kDeepestFormula) continue;
    *rhs = Rewritten(*rhs, [&](const Term& part) -> std::optional<Term> {
      if (!(part == opened.arguments[target])) return std::nullopt;
      wrote = true;
      return formula;
    });
  }
  if (wrote) *names = opened.names;
}

std::string ModelInstanceText(const KnowledgeBase& knowledge, const Term& imdl,
                              const std::vector<std::string>& names, Writing writing) {
  const std::optional<InstanceSides> sides = SidesOfInstance(knowledge, imdl, names);
  if (!sides) return ValueText(imdl, names);
  return MakesText(knowledge, *sides, writing);
}

ModelLines LinesOf(const KnowledgeBase& knowledge, const Model& model) {
  const Names names =
      IsRequirement(model) ? NamesLikeItsState(knowledge, model) : VariableNames(knowledge, model);
  Term rhs = RightSide(model);
  Names rhs_names = names;
  WriteFormulas(knowledge, model.lhs.payload, &rhs, &rhs_names);
  ModelLines lines{SideText(knowledge, model.lhs.positive, model.lhs.payload, names),
                   SideText(knowledge, model.rhs.positive, rhs, rhs_names),
                   {}};
  NoteVariables(model.lhs.payload, names, &lines.variables);
  NoteVariables(rhs, rhs_names, &lines.variables);
  return lines;
}

ModelLines LinesOfTarget(const KnowledgeBase& knowledge, const Model& requirement) {
  const std::optional<InstanceSides> sides =
      SidesOfInstance(knowledge, requirement.rhs.payload, NamesLikeItsState(knowledge, requirement));
  if (!sides) return {};
  ModelLines lines{SideText(knowledge, sides->lhs_positive, sides->lhs, sides->names),
                   SideText(knowledge, sides->rhs_positive, sides->rhs, sides->rhs_names),
                   {}};
  NoteVariables(sides->lhs, sides->names, &lines.variables);
  NoteVariables(sides->rhs, sides->rhs_names, &lines.variables);
  return lines;
}

std::string TitleOf(const KnowledgeBase& knowledge, CompositeStateId id) {
  const CompositeStateRecord* record = knowledge.Find(id);
  return record ? OneLine(ConditionsOf(knowledge, record->state)) : IdText(id);
}

std::string TitleOf(const KnowledgeBase& knowledge, ModelId id) {
  const ModelRecord* record = knowledge.Find(id);
  if (!record) return IdText(id);
  const Model& model = record->model;
  const ModelRecord* target = knowledge.Find(TargetModel(model));
  switch (KindOf(model)) {
    case ModelKind::kWeakRequirement:
    case ModelKind::kStrongRequirement: {
      const std::string title =
          target ? ActionTitle(knowledge, model, target->model) : LinesOf(knowledge, model).rhs;
      return (model.rhs.positive ? "" : "veto: ") + title + Earlier(model);
    }
    case ModelKind::kReuse:
      return ReuseTitle(knowledge, model);
    case ModelKind::kDrive:
      return "drive: " + LinesOf(knowledge, model).rhs;
    case ModelKind::kCausal:
      return LinesOf(knowledge, model).lhs;
  }
  return {};
}

std::string ExplanationOf(const KnowledgeBase& knowledge, ModelId id) {
  const ModelRecord* record = knowledge.Find(id);
  if (!record) return {};
  const Model& model = record->model;
  const ModelLines lines = LinesOf(knowledge, model);
  switch (KindOf(model)) {
    case ModelKind::kWeakRequirement:
      return Sentence("If " + lines.lhs + ", then " + Later(model) + lines.rhs);
    case ModelKind::kStrongRequirement: {
      const Names names = NamesLikeItsState(knowledge, model);
      return Sentence("If " + lines.lhs + ", then " + Later(model) + "it is not so that " +
                      PayloadText(knowledge, model.rhs.payload, names));
    }
    case ModelKind::kReuse:
      return Sentence("Whenever " + lines.lhs + ", then also " + lines.rhs);
    case ModelKind::kDrive:
      return Sentence("To satisfy " + lines.rhs + ", " + lines.lhs + " is wanted");
    case ModelKind::kCausal: {
      const Names names = VariableNames(knowledge, model);
      return Sentence(MakesText(knowledge, {model.lhs.positive, model.rhs.positive, model.lhs.payload,
                                            RightSide(model), names, names}));
    }
  }
  return {};
}

}  // namespace aerascope
