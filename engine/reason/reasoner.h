// The Reasoner is the agent's mind: it is told what is sensed each frame, keeps its knowledge by learning
// from change and from the outcomes of its predictions, and says which command it wants for a drive.
//
// A frame goes (semantics 7.3): BeginFrame(facts) - outcomes of predictions and drives, evidence, induction,
// forward chaining; then SetDrive/Decide for goals and plans; then CommandIssued and Executed for what really
// happened. It does no input or output: everything it says are events to the sink. Not thread-safe.
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/event/event.h"
#include "engine/reason/chaining.h"
#include "engine/reason/drives.h"
#include "engine/reason/expectation.h"
#include "engine/reason/journal.h"
#include "engine/reason/parameters.h"
#include "engine/reason/situation.h"
#include "engine/reason/time_outs.h"

namespace aerascope {

// A model given by hand, with the evidence it starts with.
struct SeedModelDefinition {
  Model model;
  Evidence evidence;
  bool strong = false;
  ModelState state = ModelState::kActive;  // not deleted
};

class Reasoner {
 public:
  // The sink outlives the reasoner. `sampling_period` is the length of a frame.
  Reasoner(const ReasonerParameters& parameters, Duration sampling_period, EventSink* sink);

  const KnowledgeBase& knowledge() const { return journal_.knowledge(); }
  Journal& journal() { return journal_; }

  // Hand-given knowledge, before the first frame. Composite states and models come with numbers of their own
  // and are renumbered; a definition refers only to definitions before it.
  void LoadSeed(const std::vector<Term>& symbols, const std::vector<Fact>& properties,
                const std::vector<CompositeState>& states, const std::vector<SeedModelDefinition>& models);

  void BeginFrame(std::int64_t frame, const std::vector<Fact>& sensed);

  // Gives a drive: something to bring about, or (not `positive`) to put an end to, by the deadline. True if
  // it is reached already. Several may be open at a time; confidence says how much each is wanted.
  bool SetDrive(const std::string& title, const Term& goal, Time deadline, bool positive = true,
                double confidence = 1);
  bool drive_open() const { return drives_.any_open(); }
  bool last_drive_reached() const { return drives_.last_reached(); }  // of the one that was closed last
  const Drives& drives() const { return drives_; }

  // The command wanted in this frame for the open drives, if a plan was found.
  using Wish = aerascope::Wish;
  std::optional<Wish> Decide();

  // A command goes to the world, from a teacher or the agent's own wish. Returns the event.
  EventId CommandIssued(const Term& command, Commander by, GoalId drive, EventId cause);
  // A command was really executed in this frame; models fire on it.
  void Executed(const Term& command, EventId issued);

 private:
  TimeInterval FrameInterval() const { return situation_.interval(); }
  Time At(Duration offset) const { return situation_.interval().after + offset; }

  void CheckPredictions();
  void Conclude(const PredictionRecord& prediction, bool success, const SituationFact* evidence);
  void LearnFromFailure(const PredictionRecord& prediction, FactId shown_by, EventId outcome);
  void GiveUpOutweighed(Time at);
  void LearnFromChanges();
  void LearnFromGoals(const std::vector<Drives::Achieved>& reached);
  void Chain(Time at);
  void OfferToRequirement(ModelId id, Time at);
  std::size_t ConditionOf(const Firing& firing) const;
  void WriteInstances(const std::vector<std::size_t>& positions, Time at);
  void ReportDecision(ModelId model, std::size_t input, const ChainingDecision& decision, Time at);
  void FireOn(std::size_t fact, Time at);
  std::size_t AddFact(Fact fact, FactSource source, Time at, const std::vector<EventId>& causes);

  ReasonerParameters parameters_;
  Duration period_;
  Journal journal_;
  // A model that fired and whose prediction is open.
  struct OpenFiring {
    Term instance;
    FactId input;
    Time frame;                               // in which it fired
    std::size_t condition = Situation::npos;  // what allowed it, as a position in that situation
    std::vector<ModelId> silenced;            // requirement models that were not allowed to speak
  };
  // A prediction that came true in this frame.
  struct CameTrue {
    PredictionRecord prediction;
    OpenFiring firing;
  };

  std::vector<SituationFact> properties_;
  std::deque<Situation> earlier_;  // finished frames before the previous one, the latest first
  Situation previous_;
  Situation situation_;
  EventId frame_started_;
  std::vector<Requirement> pending_;  // what requirement models say about later frames
  std::map<PredictionId, OpenFiring> open_firings_;
  std::vector<Fact> expected_;  // targets of predictions for this frame, come true or not
  // The same of those that were outweighed: what is predicted, if wrongly, is no surprise.
  std::vector<Fact> outweighed_;
  PredictionId last_weighed_;  // all up to this one were compared with each other
  Conclusions concluded_;      // predictions closed in this frame
  std::vector<CameTrue> came_true_;
  Expectations expectations_;
  TimeOuts time_outs_;
  Drives drives_;
};

}  // namespace aerascope
