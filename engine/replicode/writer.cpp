#include "engine/replicode/writer.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "engine/base/text.h"
#include "engine/replicode/sayable.h"
#include "engine/replicode/words.h"

namespace aerascope {
namespace {

bool IsPlainName(std::string_view name) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  const auto other = [](char c) { return (c >= '0' && c <= '9') || c == '.'; };
  return !name.empty() && letter(name.front()) &&
         std::all_of(name.begin(), name.end(), [&](char c) { return letter(c) || other(c); }) &&
         std::find(kConstantWords.begin(), kConstantWords.end(), name) == kConstantWords.end();
}

std::string InstantText(Time time) {
  if (time == kForever) return "GIGASEC";
  const bool negative = time.us < 0;
  const std::uint64_t us =
      negative ? 0 - static_cast<std::uint64_t>(time.us) : static_cast<std::uint64_t>(time.us);
  return (negative ? "-" : "") + std::to_string(us / 1'000'000) + "s:" + std::to_string(us / 1000 % 1000) +
         "ms:" + std::to_string(us % 1000) + "us";
}

std::string DurationText(Duration duration) {
  if (duration.us != 0 && duration.us % 1'000'000 == 0) return std::to_string(duration.us / 1'000'000) + "s";
  if (duration.us % 1000 == 0) return std::to_string(duration.us / 1000) + "ms";
  return std::to_string(duration.us) + "us";
}

std::string QuotedText(std::string_view text) {
  constexpr std::string_view kHex = "0123456789abcdef";
  std::string quoted = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (byte < 0x20 || byte == 0x7f) {
      quoted += "\\x";
      quoted += kHex[byte / 16];
      quoted += kHex[byte % 16];
    } else {
      quoted += c;
    }
  }
  return quoted + "\"";
}

// The success rate with as few digits as give the evidence again.
std::string RateText(const Evidence& evidence) {
  const double rate = evidence.rate();
  for (int digits = 9; digits < 17; ++digits) {
    const std::string text = FormatNumber(rate, digits);
    double read = 0;
    std::from_chars(text.data(), text.data() + text.size(), read);
    if (EvidenceOf(read, evidence.total) == evidence) return text;
  }
  std::string text;
  AppendExactNumber(rate, &text);
  return text;
}

// Writes terms; the first thing that has no form in Replicode is kept as the error.
class Writer {
 public:
  // Labels of composite states and models by number; those missing are written cst_12, mdl_14.
  std::map<std::int64_t, std::string> labels;

  // Begins a definition whose variables have these names, by number.
  void Begin(std::vector<std::string> names) {
    variables_ = std::move(names);
    met_.clear();
  }

  const std::optional<Error>& error() const { return error_; }

  // In patterns a variable has its colon and fields without meaning are wildcards; in guards variables
  // already met are bare; in stated facts the fields without meaning have values.
  enum class Place { kPattern, kGuard, kFact };

  std::string Value(const Term& term, Place place) {
    switch (term.kind()) {
      case TermKind::kNil:
        return "nil";
      case TermKind::kEntity:
      case TermKind::kOntology:
        return Name(term.name());
      case TermKind::kNumber:
        return Number(term.number());
      case TermKind::kTime:
        return InstantText(term.time());
      case TermKind::kDuration:
        return DurationText(term.duration());
      case TermKind::kString:
        return QuotedText(term.name());
      case TermKind::kBool:
        return term.boolean() ? "true" : "false";
      case TermKind::kVariable:
        return Variable(term.variable(), place);
      case TermKind::kWildcard:
        return ":";
      case TermKind::kSet:
        return "[" + Items(term, place) + "]";
      case TermKind::kStruct:
        return Struct(term, place);
      case TermKind::kCompositeState:
      case TermKind::kModel:
        return Fail("a reference to knowledge as a value");
    }
    return {};
  }

  std::string Payload(const Term& payload, Place place) {
    const std::string salience = place == Place::kFact ? " 1)" : " :)";
    if (IsValue(payload) || IsCommand(payload))
      return "(" + payload.name() + " " + Items(payload, place) + salience;
    if ((IsIcst(payload) && payload[0].is(TermKind::kCompositeState)) ||
        (IsImdl(payload) && payload[0].is(TermKind::kModel))) {
      return "(" + payload.name() + " " + Label(payload[0]) + " " + Value(payload[1], place) + " " +
             Value(payload[2], place) + (place == Place::kFact ? " true" : " :") + salience;
    }
    if (payload.is(TermKind::kEntity)) return Name(payload.name());
    return Fail("the payload " + ToText(payload));
  }

  std::string Pattern(const FactPattern& pattern) {
    return std::string(pattern.positive ? "(fact " : "(|fact ") + Payload(pattern.payload, Place::kPattern) +
           " " + Value(pattern.after, Place::kPattern) + " " + Value(pattern.before, Place::kPattern) +
           " : :)";
  }

  std::string Guards(const std::vector<Guard>& guards) {
    if (guards.empty()) return "|[]\n";
    std::string text = "[]\n";
    for (const Guard& guard : guards) {
      const std::string expression = Expression(guard.expression);
      text += "   " + (guard.target ? Variable(*guard.target, Place::kPattern) : "") + expression + "\n";
    }
    return text;
  }

  std::string Name(const std::string& name) {
    return IsPlainName(name) ? name : Fail("the name '" + Printable(name) + "'");
  }

  std::string Number(double number) {
    std::string text;
    AppendExactNumber(number, &text);
    return text.find_first_of("ni") == std::string::npos ? text : Fail("the number " + text);
  }

 private:
  std::string Items(const Term& term, Place place) {
    std::vector<std::string> parts;
    for (const Term& item : term.items()) parts.push_back(Value(item, place));
    return Join(parts, " ");
  }

  std::string Struct(const Term& term, Place place) {
    const bool known = std::any_of(kValueStructs.begin(), kValueStructs.end(), [&](const auto& value) {
      return term.name() == value.first && term.size() == value.second;
    });
    return known ? "(" + term.name() + " " + Items(term, place) + ")" : Fail("the value " + ToText(term));
  }

  std::string Expression(const Term& term) {
    const auto is_operator = [&](const auto& words) {
      return std::any_of(words.begin(), words.end(),
                         [&](const auto& word) { return term.name() == word.first; });
    };
    const bool operation = term.is(TermKind::kStruct) && term.size() == 2 &&
                           (is_operator(kArithmeticWords) || is_operator(kTestWords));
    if (!operation) return Value(term, Place::kGuard);
    const std::string first =
        Expression(term[0]);  // in order: a variable has its colon where it is met first
    return "(" + term.name() + " " + first + " " + Expression(term[1]) + ")";
  }

  std::string Variable(int variable, Place place) {
    const auto i = static_cast<std::size_t>(variable);
    const bool is_new = met_.insert(variable).second;
    return (i < variables_.size() ? variables_[i] : "v" + std::to_string(variable)) +
           (place == Place::kGuard && !is_new ? "" : ":");
  }

  std::string Label(const Term& reference) {
    const bool is_state = reference.is(TermKind::kCompositeState);
    const std::int64_t id = is_state ? reference.composite_state().value : reference.model().value;
    const auto it = labels.find(id);
    return it != labels.end() ? it->second : (is_state ? "cst_" : "mdl_") + std::to_string(id);
  }

  std::string Fail(const std::string& what) {
    if (!error_)
      error_ =
          Error{"expected knowledge that Replicode can say, found " + what + ", which has no form there"};
    return {};
  }

  std::vector<std::string> variables_;
  std::set<int> met_;
  std::optional<Error> error_;
};

class SeedWriter {
 public:
  explicit SeedWriter(const SeedKnowledge& seed) : seed_(seed) {
    CollectSymbols();
    for (const std::string_view word : kConstantWords) taken_.emplace(word);
  }

  Result<std::string> Run() {
    std::string text;
    for (const Term& symbol : symbols_) {
      text +=
          writer_.Name(symbol.name()) + (symbol.is(TermKind::kEntity) ? ":(ent 1) |[]\n" : ":(ont 1) |[]\n");
    }
    std::string definitions;
    // Both lists are in order of their numbers; a composite state refers to composite states only.
    for (const SeedCompositeState& item : seed_.composite_states) {
      writer_.labels[item.state.id.value] =
          FreeLabel(item.label, "cst_" + std::to_string(item.state.id.value));
    }
    for (const SeedModel& item : seed_.models) {
      writer_.labels[item.model.id.value] =
          FreeLabel(item.label, "mdl_" + std::to_string(item.model.id.value));
    }
    for (const SeedCompositeState& item : seed_.composite_states)
      definitions += "\n" + CompositeStateText(item.state);
    for (const SeedModel& item : seed_.models) definitions += "\n" + ModelText(item);
    if (!seed_.facts.empty() && !text.empty()) definitions += "\n";
    writer_.Begin({});
    for (const SeedFact& item : seed_.facts) definitions += FactText(item);
    if (writer_.error()) return *writer_.error();
    return text + definitions;
  }

 private:
  // What is declared, and then, in order of appearance, what is used without having been declared: names
  // stand in the text before their use.
  void CollectSymbols() {
    const auto add = [&](const Term& part) {
      const bool symbol = part.is(TermKind::kEntity) || part.is(TermKind::kOntology);
      if (symbol && taken_.insert(part.name()).second) symbols_.push_back(part);
    };
    for (const Term& symbol : seed_.symbols) add(symbol);
    const auto add_all = [&](const Term& term) { ForEachTerm(term, add); };
    for (const SeedCompositeState& item : seed_.composite_states) add_all(DefinitionToTerm(item.state));
    for (const SeedModel& item : seed_.models) add_all(DefinitionToTerm(item.model));
    for (const SeedFact& item : seed_.facts) add_all(item.fact.payload);
  }

  // The wanted name if it can be used, else the other one, made unlike all names so far.
  std::string FreeLabel(const std::string& wanted, const std::string& other) {
    std::string label = IsPlainName(wanted) && !taken_.contains(wanted) ? wanted : other;
    while (taken_.contains(label)) label += "_";
    taken_.insert(label);
    return label;
  }

  void NameVariables(const std::vector<std::string>& names) {
    std::set<std::string> used;
    std::vector<std::string> chosen;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const bool usable = IsPlainName(names[i]) && !taken_.contains(names[i]) && !used.contains(names[i]);
      std::string name = usable ? names[i] : "v" + std::to_string(i);
      while (taken_.contains(name) || used.contains(name)) name += "_";
      used.insert(name);
      chosen.push_back(std::move(name));
    }
    writer_.Begin(std::move(chosen));
  }

  std::string CompositeStateText(const CompositeState& state) {
    NameVariables(state.variable_names);
    std::string text = writer_.labels[state.id.value] + ":(cst [] []\n";
    for (const FactPattern& component : state.components) text += "   " + writer_.Pattern(component) + "\n";
    text += writer_.Guards(state.guards);
    return text + "|[]\n[stdin] 1) |[]\n";
  }

  // A phased-out model is without activation in the primary group and has its success rate in the secondary
  // one.
  static std::string Views(const SeedModel& item) {
    if (item.state == ModelState::kActive) return "|[]";
    const auto view = [](std::string_view group, const std::string& activation) {
      return "[SYNC_ONCE now 1 forever " + std::string(group) + " nil " + activation + "]";
    };
    return "[" + view(kPrimaryGroup, "0") + " " + view(kSecondaryGroup, RateText(item.evidence)) + "]";
  }

  std::string ModelText(const SeedModel& item) {
    const Model& model = item.model;
    NameVariables(model.variable_names);
    std::string text = writer_.labels[model.id.value] + ":(mdl " +
                       writer_.Value(Term::Set(model.template_arguments), Writer::Place::kPattern) +
                       " []\n   " + writer_.Pattern(model.lhs) + "\n   " + writer_.Pattern(model.rhs) + "\n";
    text += writer_.Guards(model.forward);  // one by one: a variable has its colon where it is met first
    text += writer_.Guards(model.backward);
    return text + "[stdin] " + (item.strong ? "1 " : "0 ") + writer_.Number(item.evidence.total) + " " +
           RateText(item.evidence) + " 1 1) " + Views(item) + "\n";
  }

  std::string FactText(const SeedFact& item) {
    std::string text;
    if (IsPlainName(item.label) && taken_.insert(item.label).second) text = item.label + ":";
    return text + (item.fact.positive ? "(fact " : "(|fact ") +
           writer_.Payload(item.fact.payload, Writer::Place::kFact) + " " +
           InstantText(item.fact.interval.after) + " " + InstantText(item.fact.interval.before) + " " +
           writer_.Number(item.fact.confidence) + " 1) |[]\n";
  }

  const SeedKnowledge& seed_;
  std::vector<Term> symbols_;
  Writer writer_;
  std::set<std::string> taken_;
};

}  // namespace

Result<std::string> WriteReplicode(const SeedKnowledge& seed) {
  const Result<SeedKnowledge> normalised = Normalised(seed);
  if (!normalised) return normalised.error();
  if (Status sayable = CheckSayable(*normalised); !sayable) return sayable.error();
  return SeedWriter(*normalised).Run();
}

Result<std::string> WritePayload(const Term& payload) {
  Writer writer;
  std::string text = writer.Payload(payload, Writer::Place::kFact);
  if (writer.error()) return *writer.error();
  return text;
}

}  // namespace aerascope
