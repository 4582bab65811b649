// The paper's pick-and-place task on one line, driven by hand: what tests of the reasoner share.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/reason/reasoner.h"
#include "engine/world/scripted_world.h"

namespace aerascope {

// Keeps every event, in order.
class EventList : public EventSink {
 public:
  void Append(Event event) override { events.push_back(std::move(event)); }

  template <class Body>
  std::vector<const Body*> All() const {
    std::vector<const Body*> found;
    for (const Event& event : events) {
      if (const auto* body = std::get_if<Body>(&event.body)) found.push_back(body);
    }
    return found;
  }

  std::vector<Event> events;
};

class PickAndPlace {
 public:
  explicit PickAndPlace(ReasonerParameters parameters = {}, ScriptedWorldConfig config = Config());

  // One frame in which the teacher commands.
  void Teach(const std::string& command);  // "move c1", "grab_type_1", "release"
  // Gives the drives one after the other, each until it is reached or `frames` are over; how many were
  // reached.
  int Pursue(const std::vector<Term>& goals, int frames = 8);
  void TeachBothGrasps();  // the six commands of the guided phase

  Term Holding(const std::string& object) const;  // (mk.val h holding [object]); "" for nothing

  EventList events;
  Reasoner reasoner;
  std::vector<std::string> commands;

  // What the seed says and the scripted world is like; changed before the first frame.
  static ScriptedWorldConfig Config();

 private:
  void Begin();
  void Act(const Term& command, Commander by, GoalId drive, EventId cause);

  std::unique_ptr<World> world_;
  std::int64_t frame_ = -1;
};

}  // namespace aerascope
