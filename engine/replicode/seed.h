// SeedKnowledge is what a Replicode text says, as plain data: symbols, facts, composite states, models.
//
// Always true of what ReadReplicode and Normalised give: (1) composite states and models are numbered 1, 2,
// ... in one numbering, in the order of the text, and refer to each other by these numbers, always backwards;
// (2) variables are numbered by first appearance (template, then patterns, then guards), so argument lists
// have the order written in the text; (3) all components of a composite state have the interval variables of
// its first one.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/kb/composite_state.h"
#include "engine/kb/fact.h"
#include "engine/kb/knowledge_base.h"
#include "engine/kb/model.h"

namespace aerascope {

struct SeedFact {
  std::string label;  // may be empty
  Fact fact;
};

struct SeedCompositeState {
  std::string label;
  CompositeState state;
};

struct SeedModel {
  std::string label;
  Model model;
  Evidence evidence;
  bool strong = false;
  ModelState state = ModelState::kActive;  // active or phased out
};

struct SeedKnowledge {
  std::vector<Term> symbols;
  std::vector<SeedFact> facts;
  std::vector<SeedCompositeState> composite_states;
  std::vector<SeedModel> models;

  // Only when reading OpenAERA's own texts: how many objects of classes that are not knowledge were passed
  // over, by class, and one sentence for each object that should have been read and could not be.
  std::map<std::string, int> passed_over;
  std::vector<std::string> problems;
};

// The same knowledge with `offset` added to every number and every reference to it.
SeedKnowledge ShiftIds(SeedKnowledge seed, std::int64_t offset);

// The symbol, composite state or model with this name or label; null if there is none.
const Term* FindSymbol(const SeedKnowledge& seed, std::string_view name);
const SeedCompositeState* FindState(const SeedKnowledge& seed, std::string_view label);
const SeedModel* FindModel(const SeedKnowledge& seed, std::string_view label);

// The same content with the properties listed above. Fails where knowledge refers to something that is not
// there, or to itself.
Result<SeedKnowledge> Normalised(const SeedKnowledge& seed);

// Everything in a knowledge base that can be written as a seed: symbols, facts that hold for ever, composite
// states, and models that are not deleted and do not speak about deleted ones. Labels are cst_12, mdl_14,
// with the episode's numbers.
SeedKnowledge SeedFrom(const KnowledgeBase& knowledge);

}  // namespace aerascope
