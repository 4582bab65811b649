// Forward chaining without side effects: which composite states hold in a situation, what the requirement
// models say about that, and what models predict from a fact (semantics 3.1 to 3.3). The live reasoner and
// its simulations use the same three functions.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "engine/kb/knowledge_base.h"
#include "engine/reason/situation.h"

namespace aerascope {

// One way the components of a composite state hold together.
struct JointMatch {
  Bindings bindings;               // interval variables included
  std::vector<std::size_t> facts;  // positions in the situation, in order of the components
  TimeInterval interval;           // common to all
  double confidence = 1;           // the least of the components'
};

// How much a join may do: sets of facts given, and facts tried for a component. Beyond that it is cut, the
// same on every machine; with what belongs together in a knowledge base neither is ever near.
struct JoinLimits {
  std::size_t matches = 4096;
  std::size_t steps = 200000;
};

// What joins did, summed up over calls.
struct JoinWork {
  std::int64_t steps = 0;  // facts tried for a component
  std::int64_t cut = 0;    // joins that met a limit
};

// All ways the components hold together under `bindings`, in a fixed order, each set of facts once, up to the
// limits.
std::vector<JointMatch> JointMatches(const CompositeState& state, const Situation& situation,
                                     const Bindings& bindings, const JoinLimits& limits = {},
                                     JoinWork* work = nullptr);

// Some fact of the situation fits this component of a composite state that may hold; so do `met` of all
// components.
struct ComponentMet {
  CompositeStateId state;
  std::size_t component = 0;
  std::size_t fact = 0;  // position of the first fact that fits
  std::size_t met = 0;
  std::size_t total = 0;
};
using OnComponentMet = std::function<void(const ComponentMet&)>;

// Adds the instances of one composite state, or of all that the facts can match (nested ones before those
// that contain them), to the situation. Returns the positions added. An instance that is there already is not
// added again.
std::vector<std::size_t> AddInstances(const CompositeState& state, Situation* situation,
                                      JoinWork* work = nullptr);
std::vector<std::size_t> AddInstances(const KnowledgeBase& knowledge, Situation* situation,
                                      JoinWork* work = nullptr, const OnComponentMet& on_met = {});

// What the requirement model says in this situation. Deleted models say nothing; phased out ones speak with
// confidence 0.
std::vector<Requirement> RequirementsFrom(const ModelRecord& requirement, const Situation& situation);

// The requirement models that facts of the situation can set off: those that speak about other requirement
// models first, then strong ones before weak ones, then by id (semantics 7.4).
std::vector<ModelId> RequirementModelsFor(const KnowledgeBase& knowledge, const Situation& situation);

// One firing of a model on a fact.
struct Firing {
  ModelId model;
  Bindings bindings;
  Fact target;                            // confidence = input x model; 0 if vetoed
  Term instance;                          // (imdl ...) payload
  std::vector<std::size_t> requirements;  // positions in situation.requirements(): the positive ones it used
  std::vector<std::size_t> vetoes;        // the same: the negative ones that speak about this very instance
  bool vetoed = false;                    // a strong requirement stands against it: predicted silently
};

// Why a model fired on a fact, or did not (semantics 3.3).
struct ChainingDecision {
  ChainingStatus status = ChainingStatus::kNoRequirement;
  std::vector<std::size_t> considered;   // positions in situation.requirements(), those that fit
  std::size_t winner = Situation::npos;  // the one that decided, if one did
};

// RequirementsFrom, each statement as far as requirement models on this one allow it: they must have spoken
// before (semantics 3.3, one level up). A statement that is not allowed has confidence 0: what rests on it is
// predicted silently. `decisions`, one for each statement, if there are requirement models on this one.
std::vector<Requirement> StatementsOf(const ModelRecord& requirement, const KnowledgeBase& knowledge,
                                      const Situation& situation,
                                      std::vector<ChainingDecision>* decisions = nullptr);

// What the model predicts from the fact, given the requirements in the situation (semantics 3.3). One firing
// for each distinct target.
std::vector<Firing> Fire(const ModelRecord& model, const KnowledgeBase& knowledge, const Fact& input,
                         const Situation& situation, std::optional<ChainingDecision>* decision = nullptr);

// The requirement models that spoke for or against the firing, those on requirement models included.
std::vector<ModelId> SpokenFor(const Firing& firing, const Situation& situation);
// Those of them that were not allowed to.
std::vector<ModelId> SilencedIn(const Firing& firing, const Situation& situation);

}  // namespace aerascope
