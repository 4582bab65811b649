// Retrieval: which conditions of a model are worth comparing with the situation for a goal (semantics 11.2,
// point 5).
//
// An inverted index lists, for each causal model, what the conditions of its requirement models ask of the
// individuals that a goal names: "attribute = value" -> requirement models. One pass over what is known of
// these individuals counts the hits of all conditions; only those that can be familiar enough are compared in
// full, and the nearest of the others, so that one sees why not.
//
// Never misses: the count is an upper bound of what the full comparison keeps (matched or achievable). What
// some model could change is no part of the index, since it may come to match.
#pragma once

#include <map>
#include <set>
#include <utility>
#include <vector>

#include "engine/kb/knowledge_base.h"
#include "engine/reason/parameters.h"
#include "engine/reason/situation.h"

namespace aerascope {

class Retrieval {
 public:
  // The weak requirement models of `model` to be considered for a goal that names these individuals (all that
  // the model's right side speaks about): learned ones before those derived by analogy, then by id. At most
  // `near_misses` of those that cannot be familiar enough are among them.
  std::vector<ModelId> Candidates(const KnowledgeBase& knowledge, ModelId model,
                                  const std::vector<Term>& individuals, const Situation& situation,
                                  const ReasonerParameters& parameters, std::size_t near_misses);

 private:
  using Key = std::pair<Term, Term>;  // attribute, value
  struct Posting {
    ModelId requirement;
    int component = 0;
  };
  struct Condition {
    int components = 0;
    std::map<int, int> asks;  // component -> how many different keys it asks for; none if it asks for nothing
  };
  // The requirement models of one causal model.
  struct Shelf {
    ModelId last;  // the newest one listed
    std::map<Key, std::vector<Posting>> postings;
    std::map<ModelId, Condition> conditions;
    std::map<std::pair<int, int>, std::vector<ModelId>>
        by_size;  // (components, components that ask) -> which
  };

  void NoteWhatCanChange(const KnowledgeBase& knowledge);
  void CatchUp(const KnowledgeBase& knowledge, ModelId model, Shelf* shelf);

  std::map<ModelId, Shelf> shelves_;
  ModelId last_model_;         // the newest one whose right side was noted
  std::set<Term> changeable_;  // attributes that some model changes
  bool anything_can_change_ = false;
};

}  // namespace aerascope
