// A Run is a loaded episode: its events in order, with the indexes that questions need.
//
// It is immutable once made and may be used from any thread. Events of a run that was cut short are there up
// to the last one committed; complete() says so. Definitions of knowledge never change, so descriptions use
// final_knowledge(); confidences and states do, so ask KnowledgeBaseAt().
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "engine/base/result.h"
#include "engine/event/event.h"
#include "engine/store/episode_reader.h"

namespace aerascope {

// Anything in an episode that has a number.
using ObjectId = std::variant<EventId, FactId, GoalId, PredictionId, CompositeStateId, ModelId, SimulationId>;

// "mdl_14", "cst_12", "#214", "fact_3", "goal_7", "pred_9", "sim_4"; "none" for zero.
std::string IdText(const ObjectId& id);
// Reads what IdText writes (and a bare number as an event), whether or not any episode has it.
Result<ObjectId> ParseObjectId(std::string_view text);

// One sampling period.
struct RunFrame {
  std::int64_t number = 0;  // as the events of it say (Event::frame)
  TimeInterval interval;
  EventId first;  // its FrameStarted event
  EventId last;   // the last event before the next frame
};

class Run {
 public:
  // Event ids are 1, 2, 3 ...; from the first one that is not, events are left out and the run is incomplete.
  static Run FromEvents(EpisodeFile file);

  const EpisodeHeader& header() const { return file_.header; }
  const std::vector<Event>& events() const { return file_.events; }
  // Whether the episode was run to its end; if not, the last event is all that is known.
  bool complete() const { return file_.complete; }
  const std::optional<Hash128>& stored_digest() const { return file_.stored_digest; }
  const EpisodeStarted& started() const { return started_; }  // empty if the first event is missing
  const EpisodeEnded* ended() const;
  // The scenario's title; "Untitled episode" where there is none.
  std::string title() const;
  // End of the last frame, or the last event's time where that is later.
  Time end() const { return end_; }

  const std::vector<RunFrame>& frames() const { return frames_; }
  // Position in frames() of the frame in which t lies; the first or last one outside; nothing without frames.
  std::optional<std::size_t> FrameAt(Time t) const;

  const Event* Find(EventId id) const;
  // The event's body if it is of this kind, else null.
  template <class Body>
  const Body* FindBody(EventId id) const {
    const Event* event = Find(id);
    return event ? std::get_if<Body>(&event->body) : nullptr;
  }
  std::span<const EventId> Causes(EventId id) const;
  // The events that name this one as a cause, in order.
  std::span<const EventId> Effects(EventId id) const;

  // Events of one kind (position in EventBody), in order.
  const std::vector<EventId>& OfKind(std::size_t kind) const { return by_kind_[kind]; }
  template <class Body>
  const std::vector<EventId>& OfKind() const {
    return OfKind(KindIndex<Body>());
  }

  // The event that brought the object into being (an event is its own); invalid if the episode has no such
  // object.
  EventId CreationOf(const ObjectId& id) const;
  // The object that text names; an error with the nearest thing that exists otherwise.
  Result<ObjectId> FindObject(std::string_view text) const;
  // What a fact, an instance (icst) or a model instance (imdl) says; null if the episode has no such fact.
  const Fact* FindFact(FactId id) const;

  // Everything the agent held after all events up to and including time t, or up to and including an event.
  // Costs at most a copy of a knowledge base and a bounded number of events.
  KnowledgeBase KnowledgeBaseAt(Time t) const;
  KnowledgeBase KnowledgeBaseAfter(EventId id) const;
  const KnowledgeBase& final_knowledge() const { return final_knowledge_; }

 private:
  struct Checkpoint {
    std::size_t events = 0;  // how many events are in it
    KnowledgeBase knowledge;
  };
  template <class Body, std::size_t I = 0>
  static constexpr std::size_t KindIndex() {
    if constexpr (std::is_same_v<Body, EventBodyAt<I>>)
      return I;
    else
      return KindIndex<Body, I + 1>();
  }
  std::size_t PositionOf(EventId id) const;  // events().size() if there is none
  KnowledgeBase KnowledgeBaseAfterEvents(std::size_t count) const;
  void IndexEvents();
  void IndexCreations();
  void IndexEffects();
  void IndexFrames();
  void FoldKnowledge();
  std::string NearestTo(const ObjectId& id) const;
  std::string SameNumber(const ObjectId& id) const;

  EpisodeFile file_;
  EpisodeStarted started_;
  Time end_;
  std::vector<RunFrame> frames_;
  std::vector<std::vector<EventId>> by_kind_;
  std::vector<std::size_t>
      effects_begin_;  // per event, where its effects begin in effects_; one more at the end
  std::vector<EventId> effects_;
  // Per kind of id, the numbers in use with the event that created each, ascending.
  std::array<std::vector<std::pair<std::int64_t, EventId>>, std::variant_size_v<ObjectId>> creations_;
  std::vector<Time> latest_;  // per event, the latest time up to it
  std::vector<Checkpoint> checkpoints_;
  KnowledgeBase final_knowledge_;
};

// Opens an episode file and indexes it.
Result<Run> OpenRun(const std::string& path);

}  // namespace aerascope
