// Knowledge and events as short English for people: the one place where words are made for report, sheet,
// graph and terminal. Nothing here knows about arms or grasping; the words come from the scenario's own
// symbols.
//
// Three attributes have a wording of their own: `position P` reads "at P", `essence hand` reads "hand", and
// the values of `essence` and `shape` serve as nouns in titles. All text is safe on one line (Printable) and
// plain, not markup.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/query/run.h"

namespace aerascope {

// One line of a composite state. Nested composite states are written out: their conditions on one thing make
// one line.
struct Condition {
  std::string subject;   // "C"
  std::string relation;  // "size"; "hand at"; "not holding" for an anti-fact
  std::string value;     // "large, at P"
  std::string text;      // "C size large, at P"
  std::string brief;     // for the one-line form: "large"; empty where a one-line form leaves it out
  std::vector<std::size_t> components;  // positions of the components it stands for
  std::vector<std::string> variables;   // names of the variables in `text`, in order, no repeats
  bool pruned = false;                  // it was in the state this one was generalised from, and was dropped
};

// A name for each variable: the given ones, else those of nested states, else by role (T for times, the
// attribute's first letter for values, X Y Z for things). No two are equal.
std::vector<std::string> VariableNames(const KnowledgeBase& knowledge, const CompositeState& state);
std::vector<std::string> VariableNames(const KnowledgeBase& knowledge, const Model& model);
// By role only, so equal for equal content whatever names were given: for snapshots and comparisons.
std::vector<std::string> CanonicalNames(const KnowledgeBase& knowledge, const CompositeStateRecord& record);
std::vector<std::string> CanonicalNames(const KnowledgeBase& knowledge, const ModelRecord& record);

std::vector<Condition> ConditionsOf(const KnowledgeBase& knowledge, const CompositeState& state);
std::vector<Condition> ConditionsOf(const KnowledgeBase& knowledge, const CompositeState& state,
                                    const std::vector<std::string>& names);
// With canonical names and in canonical order: equal for equal content.
std::vector<Condition> CanonicalConditions(const KnowledgeBase& knowledge,
                                           const CompositeStateRecord& record);
// For a state made by analogy: the lines of its source in order, those it dropped marked as pruned; its own
// variable names. For any other state the same as ConditionsOf. Empty if there is no such state.
std::vector<Condition> ConditionsWithPruned(const KnowledgeBase& knowledge, CompositeStateId id);
// Of the state that a requirement model asks for: with what was pruned where the model was generalised, too.
// One that was learned on a state which an analogy had made before dropped nothing.
std::vector<Condition> ConditionsOfRequirement(const KnowledgeBase& knowledge, const Model& requirement);
// "H holding [] · cube · large"; pruned conditions are left out.
std::string OneLine(const std::vector<Condition>& conditions);

// The two sides of a model, guards written into the right side: "move [H D]" and "H at P + D".
struct ModelLines {
  std::string lhs;
  std::string rhs;
  std::vector<std::string> variables;  // names of the variables in both
};
ModelLines LinesOf(const KnowledgeBase& knowledge, const Model& model);
// The two sides of the model that a requirement model speaks about, in the names of the requirement model: so
// that they read on from its condition. Without an instance of a known model on its right side: empty.
ModelLines LinesOfTarget(const KnowledgeBase& knowledge, const Model& requirement);

// A composite state: "H hand at P"; a causal model: "grab_type_2 [H]"; a requirement model: "grab_type_2
// something large", "grab_type_1 a small cube", "move the hand", "veto: release a sphere, seen 0.2 s before"
// where the condition held earlier. Unknown ids: their id text.
std::string TitleOf(const KnowledgeBase& knowledge, ModelId id);
std::string TitleOf(const KnowledgeBase& knowledge, CompositeStateId id);
// How long after its condition a requirement model speaks of: 0 where it speaks of the same time; nothing if
// that cannot be told, or for other models.
std::optional<Duration> DelayOf(const Model& model);
// "If H holding [], C size large at P and H hand at P, then grab_type_2 [H] makes H holding [C]."
std::string ExplanationOf(const KnowledgeBase& knowledge, ModelId id);

// A payload: "h holding [s1]", "h at (0.15, 0.07)", "grab_type_2 [h]"; instances of composite states as their
// conditions, instances of models as "grab_type_2 [h] makes h holding [s1]". Without names variables get
// those of the knowledge they belong to where that can be told.
std::string PayloadText(const KnowledgeBase& knowledge, const Term& payload,
                        const std::vector<std::string>& names = {});
// A step of a plan: its command, or "wait" where what is wanted comes by itself.
std::string StepText(const KnowledgeBase& knowledge, const PlanStep& step);
// With "not " in front of an anti-fact; without interval.
std::string FactText(const KnowledgeBase& knowledge, const Fact& fact);
// A value for people: at most four decimals, vectors as (x, y).
std::string ValueText(const Term& value, const std::vector<std::string>& names = {});

// How knowledge came about: "given", "learned from a failed prediction", "made by analogy".
std::string_view WordsOf(Origin origin);

// What the variables of a composite state stand for in an instance: name and value, unbound ones left out.
struct Binding {
  std::string variable;
  std::string value;
  bool operator==(const Binding&) const = default;
};
std::vector<Binding> BindingsOf(const KnowledgeBase& knowledge, const Term& icst_payload);
std::string BindingsText(const std::vector<Binding>& bindings);  // "H = h, C = s1, P = (0.15, 0.07)"

// One event as one sentence: "Goal reached: h holding [s1].", "3 of 4 conditions of cst_31 hold; `C shape
// cube` is pruned: mdl_44 starts at 0.75."
std::string SentenceOf(const Run& run, const Event& event);
// The frame in one or two sentences: what came out, what was learned, what is done next. `frame` is a
// position in run.frames().
std::string SentenceOfFrame(const Run& run, std::size_t frame);

// Seconds for people: "7 s", "0.7 s".
std::string SecondsText(Time time);

}  // namespace aerascope
