#include "tests/engine/reason/pick_and_place.h"

#include <cassert>

#include "tests/engine/kb/build_terms.h"

namespace aerascope {
namespace {

constexpr Duration kFrame = Milliseconds(100);

ScriptedObject Object(const std::string& name, double position, const std::string& shape,
                      const std::string& size) {
  return {name, position, {{"shape", shape}, {"size", size}}};
}

ScriptedWorldConfig TabletopOnALine() {
  ScriptedWorldConfig config;
  config.hand_entity = "h";
  config.hand_properties = {{"essence", "hand"}};
  config.objects = {Object("c1", 5, "cube", "small"), Object("c2", 10, "cube", "large"),
                    Object("s1", 15, "sphere", "large"), Object("s2", 20, "sphere", "small"),
                    Object("cyl", 25, "cylinder", "large")};
  config.commands = {{"move", CommandKind::kMove, {}},
                     {"grab_type_1", CommandKind::kGrab, {{"size", "small"}}},
                     {"grab_type_2", CommandKind::kGrab, {{"size", "large"}}},
                     {"release", CommandKind::kRelease, {}}};
  return config;
}

// {first payload, (V(0) position V(last))} over the interval variables `after`, `before`.
CompositeState AtPosition(std::int64_t id, Term first, int position, int after,
                          std::vector<std::string> names) {
  CompositeState state;
  state.id = CompositeStateId{id};
  state.components = {{true, std::move(first), V(after), V(after + 1)},
                      {true, MakeValue(V(0), O("position"), V(position)), V(after), V(after + 1)}};
  state.variable_names = std::move(names);
  return state;
}

}  // namespace

ScriptedWorldConfig PickAndPlace::Config() {
  return TabletopOnALine();
}

PickAndPlace::PickAndPlace(ReasonerParameters parameters, ScriptedWorldConfig config)
    : reasoner(parameters, kFrame, &events) {
  auto world = MakeScriptedWorld(config);
  assert(world.ok());
  world_ = std::move(*world);
  const CompositeState s0 =
      AtPosition(1, MakeValue(V(0), O("essence"), O("hand")), 3, 1, {"H", "T0", "T1", "P"});
  const CompositeState s3 =
      AtPosition(2, MakeValue(V(0), O("shape"), V(1)), 4, 2, {"C", "X", "T0", "T1", "P"});
  const CompositeState s4 =
      AtPosition(3, MakeValue(V(0), O("size"), V(1)), 4, 2, {"C", "X", "T0", "T1", "P"});
  reasoner.LoadSeed({E("h"), E("c1"), E("c2"), E("s1"), E("s2"), E("cyl")}, world_->Properties(),
                    {s0, s3, s4}, {});
}

void PickAndPlace::Begin() {
  ++frame_;
  auto sensed = world_->Observe({Time{frame_ * kFrame.us}, Time{(frame_ + 1) * kFrame.us}});
  assert(sensed.ok());
  reasoner.BeginFrame(frame_, *sensed);
}

void PickAndPlace::Act(const Term& command, Commander by, GoalId drive, EventId cause) {
  const EventId issued = reasoner.CommandIssued(command, by, drive, cause);
  const Time start{frame_ * kFrame.us};
  auto outcome = world_->Act(std::vector<Term>{command}, {start + Milliseconds(60), start + kFrame});
  assert(outcome.ok());
  for (const Term& executed : outcome->executed) reasoner.Executed(executed, issued);
  commands.push_back(ToText(command));
}

void PickAndPlace::Teach(const std::string& command) {
  Begin();
  std::vector<Term> arguments{E("h")};
  std::string function = command;
  if (command.starts_with("move ")) {
    function = "move";
    double hand = 0;
    double object = 0;
    for (const auto& [id, record] : reasoner.knowledge().facts()) {
      const Term& payload = record.fact.payload;
      if (!IsValue(payload) || payload[1] != O("position")) continue;
      if (payload[0] == E("h")) hand = payload[2].number();
      if (payload[0] == E(command.substr(5))) object = payload[2].number();
    }
    arguments.push_back(Term::Number(object - hand));
  }
  Act(MakeCommand(O(function), arguments), Commander::kTeacher, {}, {});
}

void PickAndPlace::TeachBothGrasps() {
  for (const char* command : {"move c1", "grab_type_1", "release", "move c2", "grab_type_2", "release"})
    Teach(command);
}

Term PickAndPlace::Holding(const std::string& object) const {
  return MakeValue(E("h"), O("holding"),
                   Term::Set(object.empty() ? std::vector<Term>{} : std::vector<Term>{E(object)}));
}

int PickAndPlace::Pursue(const std::vector<Term>& goals, int frames) {
  int reached = 0;
  std::size_t next = 0;
  while (true) {
    Begin();
    if (next > 0 && !reasoner.drive_open() && reasoner.last_drive_reached()) ++reached;
    while (!reasoner.drive_open()) {
      if (next == goals.size()) return reached;
      const Term& goal = goals[next++];
      if (reasoner.SetDrive(ToText(goal), goal, Time{(frame_ + frames) * kFrame.us})) ++reached;
    }
    if (const auto wish = reasoner.Decide()) Act(wish->command, Commander::kAgent, wish->drive, wish->event);
  }
}

}  // namespace aerascope
