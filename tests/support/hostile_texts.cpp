#include "tests/support/hostile_texts.h"

#include <algorithm>
#include <concepts>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <type_traits>

#include "tests/support/paper_episode.h"

namespace aerascope {
namespace {

using std::string_literals::operator""s;

// Where a text stands.
enum class Place { kEntity, kSymbol, kVariable, kField };
using Replace = std::function<std::string(Place, const std::string&)>;

// The words that facts are built with; any other text of a term may be anything.
bool IsOfTheLanguage(const std::string& word) {
  static const std::set<std::string> kWords = {"mk.val", "cmd", "icst", "imdl", "vec2", "vec3",
                                               "ti",     "+",   "-",    "*",    "/"};
  return kWords.contains(word);
}

Term Replaced(const Term& term, const Replace& replace) {
  return Rewritten(term, [&](const Term& part) -> std::optional<Term> {
    if (part.is(TermKind::kEntity)) return Term::Entity(replace(Place::kEntity, part.name()));
    if (part.is(TermKind::kOntology)) return Term::Ontology(replace(Place::kSymbol, part.name()));
    if (part.is(TermKind::kStruct) && !IsOfTheLanguage(part.name()))
      return Term::Struct(replace(Place::kSymbol, part.name()), part.items());
    return std::nullopt;
  });
}

void ReplaceIn(Term* term, const Replace& replace) {
  *term = Replaced(*term, replace);
}
void ReplaceIn(std::string* text, const Replace& replace) {
  *text = replace(Place::kField, *text);
}
void ReplaceIn(Fact* fact, const Replace& replace) {
  ReplaceIn(&fact->payload, replace);
}
void ReplaceNames(std::vector<std::string>* names, const Replace& replace) {
  for (std::string& name : *names) name = replace(Place::kVariable, name);
}
void ReplaceIn(CompositeState* state, const Replace& replace) {
  for (FactPattern& component : state->components) ReplaceIn(&component.payload, replace);
  for (Guard& guard : state->guards) ReplaceIn(&guard.expression, replace);
  ReplaceNames(&state->variable_names, replace);
}
void ReplaceIn(Model* model, const Replace& replace) {
  for (Term& argument : model->template_arguments) ReplaceIn(&argument, replace);
  ReplaceIn(&model->lhs.payload, replace);
  ReplaceIn(&model->rhs.payload, replace);
  for (Guard& guard : model->forward) ReplaceIn(&guard.expression, replace);
  for (Guard& guard : model->backward) ReplaceIn(&guard.expression, replace);
  ReplaceNames(&model->variable_names, replace);
}
template <class Value>
void ReplaceIn(std::vector<Value>* values, const Replace& replace);
template <class Value>
requires requires {
  Value::Fields();
}
void ReplaceIn(Value* body, const Replace& replace) {
  ForEachField<Value>([&](const auto& field) {
    using Held = std::remove_cvref_t<decltype(body->*field.member)>;
    if constexpr (requires(Held * held) { ReplaceIn(held, replace); })
      ReplaceIn(&(body->*field.member), replace);
  });
}
template <class Value>
void ReplaceIn(std::vector<Value>* values, const Replace& replace) {
  if constexpr (requires(Value * value) { ReplaceIn(value, replace); }) {
    for (Value& value : *values) ReplaceIn(&value, replace);
  }
}

// The paper's story, which a command of the teacher that the world refuses is added to.
std::vector<Event> Story() {
  std::vector<Event> events = PaperEpisode();
  const auto issued = std::find_if(events.begin(), events.end(), [](const Event& event) {
    return std::holds_alternative<CommandIssued>(event.body);
  });
  const CommandRefused refused{std::get<CommandIssued>(issued->body).command, "the hand is somewhere else"};
  Event last = events.back();
  const EventId id = last.id;
  events.back() = {id, last.time, last.frame, {}, {issued->id}, refused};
  last.id = EventId{id.value + 1};
  events.push_back(last);
  return events;
}

EpisodeHeader HeaderWith(const std::vector<std::string>& texts) {
  EpisodeHeader header;
  header.program_version = texts[0];
  std::size_t next = 1;
  const auto text = [&] { return texts[next++ % texts.size()]; };
  for (const char* name : {"title", "story", "world.kind", "world.cameras", "random_seed"})
    header.settings[name] = text();
  header.settings[text()] = text();
  header.files.push_back({"scenario.toml", text()});
  header.files.push_back({"seed.replicode", text()});
  header.files.push_back({text(), text()});
  return header;
}

HostileEpisode Rewrite(const Replace& replace, EpisodeHeader header) {
  HostileEpisode episode{std::move(header), Story()};
  for (Event& event : episode.events) std::visit([&](auto& body) { ReplaceIn(&body, replace); }, event.body);
  return episode;
}

}  // namespace

std::vector<std::string> HostileTexts() {
  std::string marks = "h";  // a letter under a tower of marks
  for (int i = 0; i < 60; ++i) marks += "\u0301\u0323";
  return {
      "<script>window.pwned=1</script>",
      "</script><script>window.pwned=2</script>",
      "<img src=x onerror=window.pwned=3>",
      "\"><svg onload=window.pwned=4>",
      "' onfocus='window.pwned=5' autofocus='",
      "</style><style>*{display:none}</style>",
      "</title></text></svg><iframe src=//example.org>",
      "<!-- not closed",
      "--> ]]> <![CDATA[",
      "&lt;b&gt;&amp;&#x202e;&bogus;",
      "javascript:window.pwned=6",
      "data:text/html,<script>window.pwned=7</script>",
      "{{constructor.constructor('window.pwned=8')()}}${window.pwned=9}",
      "@data@ @script@ @title@",
      "__proto__",
      "constructor",
      "toString",
      "%s%n%n%d%1$s",
      "\\\" \\n \\u0000 \\",
      "tab\there, line\nfeed, return\rhere",
      "bell\a escape\x1b[31mred\x1b[0m\x1b]0;title\a backspace\b\b\b delete\x7f next\u0085line",
      "nul\0inside"s,
      "broken \xc3\x28 \xff\xfe \xe2\x82 \xed\xa0\x80 \xf4\x90\x80\x80 bytes",
      "right\u202eto left\u202c, \u2066isolated\u2069, mark\u200f, zero\u200bwidth, \ufeffbom",
      "\ufffe and \uffff",
      marks,
      "\U0001f469\u200d\U0001f52c \U0001f9be \u4e16\u754c \u0645\u0631\u062d\u0628\u0627 "
      "\u05e9\u05dc\u05d5\u05dd",
      "' OR 1=1; DROP TABLE event; --",
      "../../../../etc/passwd",
      "",
      " ",
  };
}

std::string EndlessText() {
  std::string text = "<b onclick=window.pwned=10>begin";
  while (text.size() < 1'000'000) text += " endless";
  return text + "</b><script>window.pwned=11</script>";
}

HostileEpisode MakeHostileEpisode(int turn) {
  std::vector<std::string> texts = HostileTexts();
  const std::size_t shift = texts.size() * static_cast<std::size_t>(turn) / kHostileTurns;
  std::rotate(texts.begin(), texts.begin() + static_cast<std::ptrdiff_t>(shift), texts.end());
  std::map<Place, std::map<std::string, std::string>> known;
  std::map<Place, std::set<std::string>> taken;
  const Replace replace = [&](Place place, const std::string& old) {
    const auto [entry, is_new] = known[place].try_emplace(old);
    if (!is_new) return entry->second;
    std::string text = texts[(known[place].size() - 1) % texts.size()];
    // What is different stays different.
    while (!taken[place].insert(text).second) text += "+";
    entry->second = text;
    return text;
  };
  return Rewrite(replace, HeaderWith(texts));
}

HostileEpisode MakeEndlessEpisode() {
  const std::string endless = EndlessText();
  EpisodeHeader header;
  header.program_version = "0.1.0";
  header.settings["title"] = endless;
  header.settings["story"] = endless;
  const Replace replace = [&](Place place, const std::string& old) {
    const bool chosen = place == Place::kField ? old == "Pick and place by analogy" || old == "hold s1" ||
                                                     old == "the hand is somewhere else"
                                               : old == "cyl" || old == "grab_type_2" || old == "P";
    return chosen ? endless + old : old;
  };
  return Rewrite(replace, header);
}

HostileEpisode MakeEpisodeWithoutNumbers() {
  HostileEpisode episode{{}, Story()};
  episode.header.program_version = "0.1.0";
  constexpr double kNone[] = {std::numeric_limits<double>::quiet_NaN(),
                              std::numeric_limits<double>::infinity(),
                              -std::numeric_limits<double>::infinity(),
                              1e308,
                              5e-324,
                              -0.0};
  std::size_t next = 0;
  const auto none = [&] { return kNone[next++ % std::size(kNone)]; };
  for (Event& event : episode.events) {
    if (auto* state = std::get_if<WorldStateRecorded>(&event.body)) {
      for (double& position : state->qpos) position = none();
    } else if (auto* prediction = std::get_if<PredictionMade>(&event.body)) {
      prediction->target.confidence = none();
    } else if (auto* moved = std::get_if<EvidenceUpdated>(&event.body)) {
      moved->after = {none(), none()};
    } else if (auto* compared = std::get_if<AnalogyCompared>(&event.body)) {
      compared->psi = none();
      compared->jaccard = none();
      compared->confidence = none();
    } else if (auto* tried = std::get_if<SimulationStarted>(&event.body)) {
      tried->score = none();
    } else if (auto* seen = std::get_if<FactObserved>(&event.body)) {
      if (seen->fact.payload.items().size() == 3 && seen->fact.payload[2].IsStruct("vec2"))
        seen->fact.payload = MakeValue(seen->fact.payload[0], seen->fact.payload[1],
                                       Term::Struct("vec2", {Term::Number(none()), Term::Number(none())}));
    }
  }
  return episode;
}

}  // namespace aerascope
