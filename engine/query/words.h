// Building blocks of sentences, shared by the descriptions of knowledge and of events; others use describe.h.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/kb/knowledge_base.h"
#include "engine/query/parts.h"

namespace aerascope {

// "a", "a and b", "a, b and c".
std::string InWords(const std::vector<std::string>& items);

// A line of a composite state, what is said of one thing parted by the separator: "C size large, at P".
std::string LineText(const Line& line, const std::vector<std::string>& names, std::string_view separator);
// A line without commas, fit for a sentence: "C size large at P".
std::string ClauseOf(const Line& line, const std::vector<std::string>& names);
// A payload as clauses; an instance of a composite state gives several.
std::vector<std::string> ClausesOf(const KnowledgeBase& knowledge, const Term& payload,
                                   const std::vector<std::string>& names,
                                   Writing writing = Writing::kAsGiven);
// The same as one phrase; PayloadText (describe.h) is this, as given.
std::string PayloadWords(const KnowledgeBase& knowledge, const Term& payload,
                         const std::vector<std::string>& names, Writing writing);

// The names of a requirement model's variables, those of its composite state where it passes them on: so that
// its explanation reads like the composite state's card.
std::vector<std::string> NamesLikeItsState(const KnowledgeBase& knowledge, const Model& requirement);

// The two sides of the model that an instance is of, with the instance's arguments written in.
struct InstanceSides {
  bool lhs_positive = true;
  bool rhs_positive = true;
  Term lhs;
  Term rhs;
  // Of the instance's variables, and behind them of those that the instance leaves open, by the model's
  // names.
  std::vector<std::string> names;
  // Of the right side's: it may say by a formula what the left side, an instance itself, computes.
  std::vector<std::string> rhs_names;
};
// Where a left side is an instance of a model that computes its effect, what the right side takes over from
// the effect is written as computed: "move [H D] makes H at P + D" makes "S at P + D". Without that nothing
// on the right would say which place it is. Adds the names that this needs behind the others.
void WriteFormulas(const KnowledgeBase& knowledge, const Term& lhs, Term* rhs,
                   std::vector<std::string>* names);
// Nothing if there is no such model.
std::optional<InstanceSides> SidesOfInstance(const KnowledgeBase& knowledge, const Term& imdl,
                                             const std::vector<std::string>& names);

// An instance of a model: "grab_type_2 [h] makes h holding [s1]". What it leaves open keeps the model's own
// names.
std::string ModelInstanceText(const KnowledgeBase& knowledge, const Term& imdl,
                              const std::vector<std::string>& names, Writing writing = Writing::kAsGiven);

// "`C shape cube`, `C size large`": conditions of a state by their components' positions.
std::string QuotedConditions(const KnowledgeBase& knowledge, const CompositeState& state,
                             const std::vector<std::size_t>& components);

}  // namespace aerascope
