#include "tests/support/paper_episode.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "engine/kb/match.h"

namespace aerascope {
namespace {

constexpr Duration kPeriod = Seconds(1);
constexpr Duration kCommandDelay = Milliseconds(20);

Term V(int index) {
  return Term::Variable(index);
}
Term Word(const char* name) {
  return Term::Ontology(name);
}
Term Point(double x, double y) {
  return Term::Struct("vec2", {Term::Number(x), Term::Number(y)});
}
Term Span(Term after, Term before) {
  return Term::Struct("ti", {std::move(after), std::move(before)});
}
Term Plus(Term a, Term b) {
  return Term::Struct("+", {std::move(a), std::move(b)});
}
Term Minus(Term a, Term b) {
  return Term::Struct("-", {std::move(a), std::move(b)});
}

struct Place {
  double x = 0;
  double y = 0;
};

// One lesson of the teacher or one drive of the agent is a few commands; each command is one frame.
struct Step {
  std::string command;  // move, grab_type_1, grab_type_2, release
  std::string object;   // what it is about
  std::string drive;    // title of the drive that begins with this step; else empty
};

// A requirement model with what it stands on: the piece of knowledge that tests call a triad.
struct Triad {
  ModelId requirement;
  CompositeStateId state;
  ModelId causal;
  EventId made;                  // the event that made the requirement
  std::vector<Term> conditions;  // payloads of the composite state, C and H as variables
  Evidence evidence;
  std::string command;
  std::string size;  // "" where the state says nothing of sizes
  bool derived = false;
};

class Author {
 public:
  explicit Author(const PaperEpisodeOptions& options) : options_(options) {
    places_ = {{"h", {0, 0}},         {"c1", {-0.16, -0.02}}, {"c2", {0.07, 0.03}},
               {"s1", {-0.13, 0.07}}, {"s2", {-0.03, -0.12}}, {options.cylinder, {0.2, 0.09}}};
  }

  std::vector<Event> Write() {
    Start();
    const std::vector<Step> steps = Steps();
    const int frames = std::min(options_.last_frame, 15);
    for (int frame = 1; frame <= frames; ++frame) {
      BeginFrame(frame);
      if (frame > 1) Judge(steps[static_cast<std::size_t>(frame - 2)]);
      if (frame <= static_cast<int>(steps.size())) Act(steps[static_cast<std::size_t>(frame - 1)]);
    }
    if (frames == 15) {
      now_ = {kPeriod.us * 15};
      Emit(EpisodeEnded{15, drives_reached_, drives_}, {});
    }
    return std::move(events_);
  }

 private:
  std::vector<Step> Steps() const {
    const std::string& last = options_.cylinder;
    return {{"move", "c1", ""},
            {"grab_type_1", "c1", ""},
            {"release", "c1", ""},
            {"move", "c2", ""},
            {"grab_type_2", "c2", ""},
            {"release", "c2", ""},
            {"move", "s1", "hold s1"},
            {"grab_type_2", "s1", ""},
            {"release", "s1", "hold nothing"},
            {"move", "s2", "hold s2"},
            {"grab_type_1", "s2", ""},
            {"release", "s2", "hold nothing"},
            {"move", last, "hold " + last},
            {"grab_type_2", last, ""}};
  }

  EventId Emit(EventBody body, std::vector<EventId> causes) {
    const EventId id{static_cast<std::int64_t>(events_.size()) + 1};
    events_.push_back({id, now_, frame_, SimulationId{simulation_}, std::move(causes), std::move(body)});
    return id;
  }
  std::int64_t NextObject() { return ++objects_; }

  TimeInterval Frame() const { return {now_, now_ + kPeriod}; }

  std::pair<FactId, EventId> Observe(Term payload, TimeInterval interval, FactSource source,
                                     std::vector<EventId> causes = {}) {
    const FactId id{NextObject()};
    const EventId event =
        Emit(FactObserved{id, {true, std::move(payload), interval, 1}, source}, std::move(causes));
    return {id, event};
  }

  Term Entity(const std::string& name) const { return Term::Entity(name); }
  Term Holding() const {
    return Term::Set(held_.empty() ? std::vector<Term>{} : std::vector<Term>{Entity(held_)});
  }

  void Start() {
    const EventId start = Emit(EpisodeStarted{options_.scenario,
                                              options_.world,
                                              7,
                                              kPeriod.us,
                                              {{"analogy_min_psi", "0.5"}, {"analogy_min_matched", "2"}}},
                               {});
    for (const auto& [name, place] : places_) Emit(SymbolDeclared{Entity(name)}, {start});
    for (const char* word : {"position", "holding", "essence", "shape", "size", "hand", "cube", "sphere",
                             "cylinder", "small", "large", "move", "grab_type_1", "grab_type_2", "release"})
      Emit(SymbolDeclared{Word(word)}, {start});
    const auto give = [&](std::vector<FactPattern> components, std::vector<std::string> names) {
      const CompositeStateId id{NextObject()};
      const CompositeState state{id, std::move(components), {}, std::move(names)};
      return std::pair{id, Emit(CompositeStateCreated{state, Origin::kSeed, {}}, {start})};
    };
    std::tie(s0_, s0_event_) = give({{true, MakeValue(V(0), Word("essence"), Word("hand")), V(1), V(2)},
                                     {true, MakeValue(V(0), Word("position"), V(3)), V(1), V(2)}},
                                    {"H", "T0", "T1", "P"});
    std::tie(s3_, s3_event_) = give({{true, MakeValue(V(0), Word("shape"), V(1)), V(2), V(3)},
                                     {true, MakeValue(V(0), Word("position"), V(4)), V(2), V(3)}},
                                    {"C", "X", "T0", "T1", "P"});
    std::tie(s4_, s4_event_) = give({{true, MakeValue(V(0), Word("size"), V(1)), V(2), V(3)},
                                     {true, MakeValue(V(0), Word("position"), V(4)), V(2), V(3)}},
                                    {"C", "X", "T0", "T1", "P"});
  }

  static std::string ShapeOf(const std::string& name) {
    if (name == "c1" || name == "c2") return "cube";
    return name == "s1" || name == "s2" ? "sphere" : "cylinder";
  }
  static std::string SizeOf(const std::string& name) {
    return name == "c1" || name == "s2" ? "small" : "large";
  }

  // The world as it is now becomes facts; the facts of the frame before are kept for induction.
  void BeginFrame(int frame) {
    frame_ = frame;
    now_ = {kPeriod.us * (frame - 1)};
    before_ = std::move(seen_);
    seen_.clear();
    Emit(FrameStarted{Frame()}, {});
    if (frame == 1) {
      Property("h", "essence", "hand");
      for (const auto& [name, place] : places_) {
        if (name == "h") continue;
        Property(name, "shape", ShapeOf(name));
        Property(name, "size", SizeOf(name));
      }
    }
    if (options_.world_states) {
      std::vector<double> qpos;
      for (const auto& [name, place] : places_) qpos.insert(qpos.end(), {place.x, place.y});
      Emit(WorldStateRecorded{now_, qpos, std::vector<double>(qpos.size(), 0.0), {0, 0}}, {});
    }
    for (const auto& [name, place] : places_)
      seen_[name + " position"] = Observe(MakeValue(Entity(name), Word("position"), Point(place.x, place.y)),
                                          Frame(), FactSource::kSensor);
    seen_["h holding"] =
        Observe(MakeValue(Entity("h"), Word("holding"), Holding()), Frame(), FactSource::kSensor);
  }
  void Property(const std::string& name, const char* attribute, const std::string& value) {
    properties_[name + " " + attribute] = Observe(
        MakeValue(Entity(name), Word(attribute), Word(value.c_str())), kAlways, FactSource::kProperty);
  }

  // What the last command led to: its efference copy, outcomes, and learning where nothing was predicted.
  void Judge(const Step& step) {
    const Time issued = now_ - kPeriod;
    const auto executed =
        Observe(last_command_, {issued + kCommandDelay, now_}, FactSource::kExecuted, {command_event_});
    const std::string changed = step.command == "move" ? "h position" : "h holding";
    if (prediction_.valid()) {
      JudgePrediction(step, seen_[changed]);
    } else if (options_.second_lesson || step.object != "c2" || step.command == "move") {
      Learn(step, before_[changed], seen_[changed], executed);
    }
    if (drive_.valid()) JudgeDrive(seen_["h holding"]);
  }

  void JudgePrediction(const Step& step, std::pair<FactId, EventId> evidence) {
    const bool came_true =
        !(options_.cylinder_slips && step.object == options_.cylinder && step.command != "move");
    const std::vector<EventId> causes = {prediction_event_, evidence.second};
    const EventId outcome = came_true ? Emit(PredictionSucceeded{prediction_, evidence.first}, causes)
                                      : Emit(PredictionFailed{prediction_, evidence.first}, causes);
    Triad& triad = triads_[used_];
    const auto rate = [&](ModelId model, Evidence& now) {
      const Evidence before = now;
      now = {before.positive + (came_true ? 1 : 0), before.total + 1};
      Emit(EvidenceUpdated{model, came_true, before, now, false, false}, {outcome});
    };
    rate(triad.causal, causal_evidence_[triad.causal]);
    rate(triad.requirement, triad.evidence);
    prediction_ = {};
  }

  void JudgeDrive(std::pair<FactId, EventId> holding) {
    const bool reached = held_ == wanted_;
    const bool late = frame_ == 15;
    if (!reached && !late) return;
    if (reached) {
      Emit(GoalAchieved{drive_, holding.first}, {drive_event_, holding.second});
      ++drives_reached_;
    } else {
      Emit(GoalFailed{drive_}, {drive_event_, holding.second});
    }
    drive_ = {};
  }

  // -------------------------------------------------------------------------------------------------- what
  // is said

  // Conditions by object: the state's variables are H, C and P (0, 3, 4) and its interval (1, 2).
  std::vector<Term> Conditions(const Step& step) const {
    const Term held = step.command == "release" ? Term::Set({V(3)}) : Term::Set({});
    return {MakeValue(V(0), Word("holding"), held),
            MakeIcst(s4_, {}, {V(3), Word(SizeOf(step.object).c_str()), V(4)}),
            MakeIcst(s0_, {}, {V(0), V(4)}),
            MakeValue(V(3), Word("shape"), Word(ShapeOf(step.object).c_str()))};
  }
  static CompositeState StateOf(CompositeStateId id, const std::vector<Term>& conditions) {
    CompositeState state{id, {}, {}, {"H", "T0", "T1", "C", "P"}};
    for (const Term& payload : conditions) state.components.push_back({true, payload, V(1), V(2)});
    return state;
  }
  static std::vector<Guard> Timing() {
    return {{7, Plus(V(1), Term::Span(kPeriod))}, {8, Plus(V(2), Term::Span(kPeriod))}};
  }
  static std::vector<Guard> BackwardTiming() {
    return {{1, Minus(V(7), Term::Span(kPeriod))}, {2, Minus(V(8), Term::Span(kPeriod))}};
  }

  Model CausalModel(ModelId id, const std::string& command) const {
    const Term function = Word(command.c_str());
    Model model{id, {V(0), Span(V(1), V(2))}, {}, {}, Timing(), BackwardTiming(), {}};
    if (command == "move") {
      model.lhs = {true, MakeCommand(function, {V(3), V(6)}), V(4), V(5)};
      model.rhs = {true, MakeValue(V(3), Word("position"), V(9)), V(7), V(8)};
      model.forward.push_back({9, Plus(V(0), V(6))});
      model.backward.push_back({6, Minus(V(9), V(0))});
      model.variable_names = {"P", "T0", "T1", "H", "T2", "T3", "D", "T4", "T5", "Q"};
      return model;
    }
    model.lhs = {true, MakeCommand(function, {V(3)}), V(4), V(5)};
    const Term held = command == "release" ? Term::Set({}) : Term::Set({V(6)});
    model.rhs = {true, MakeValue(V(3), Word("holding"), held), V(7), V(8)};
    model.variable_names = {"B", "T0", "T1", "H", "T2", "T3", "C", "T4", "T5"};
    return model;
  }

  Model Requirement(ModelId id, const std::string& command, CompositeStateId state, ModelId causal) const {
    Model model{id, {}, {}, {}, {}, {}, {}};
    if (command == "move") {
      model.lhs = {true, MakeIcst(s0_, {}, {V(0), V(1)}), V(2), V(3)};
      model.rhs = {true, MakeImdl(causal, {V(1), Span(V(2), V(3))}, {V(0), V(4), V(5), V(6), V(7)}), V(2),
                   V(3)};
      model.variable_names = {"H", "P", "T0", "T1", "D", "T4", "T5", "Q"};
      return model;
    }
    const Term held = command == "release" ? Term::Set({V(1)}) : Term::Set({});
    std::vector<Term> exposed = {V(0), V(1), V(5), V(6)};
    if (command == "release") exposed.erase(exposed.begin() + 1);
    model.lhs = {true, MakeIcst(state, {}, {V(0), V(1), V(2)}), V(3), V(4)};
    model.rhs = {true, MakeImdl(causal, {held, Span(V(3), V(4))}, std::move(exposed)), V(3), V(4)};
    model.variable_names = {"H", "C", "P", "T0", "T1", "T4", "T5"};
    return model;
  }

  // ----------------------------------------------------------------------------------------------------
  // induction

  void Learn(const Step& step, std::pair<FactId, EventId> premise, std::pair<FactId, EventId> consequent,
             std::pair<FactId, EventId> executed) {
    const EventId induction = Emit(InductionStarted{InductionKind::kChange, premise.first, consequent.first},
                                   {premise.second, consequent.second});
    const EventId cause =
        Emit(CauseConsidered{executed.first, CauseVerdict::kBuilt, step.command == "move" ? "sum" : "timing"},
             {induction, executed.second});
    const std::vector<EventId> why = {cause, premise.second, executed.second, consequent.second};
    Triad triad;
    triad.command = step.command;
    triad.state = s0_;
    if (step.command != "move") {
      triad.size = SizeOf(step.object);
      triad.conditions = Conditions(step);
      triad.state = CompositeStateId{NextObject()};
      std::vector<EventId> state_why = why;
      for (const char* attribute : {"shape", "size"})
        state_why.push_back(properties_[step.object + " " + attribute].second);
      Emit(CompositeStateCreated{StateOf(triad.state, triad.conditions), Origin::kInduction, {}}, state_why);
    }
    if (!causal_.contains(step.command)) {
      const ModelId id{NextObject()};
      causal_[step.command] = id;
      causal_evidence_[id] = {1, 1};
      Emit(ModelCreated{CausalModel(id, step.command), {1, 1}, false, Origin::kInduction, {}}, why);
    }
    triad.causal = causal_[step.command];
    triad.requirement = ModelId{NextObject()};
    triad.evidence = {1, 1};
    triad.made = Emit(ModelCreated{Requirement(triad.requirement, step.command, triad.state, triad.causal),
                                   {1, 1},
                                   false,
                                   Origin::kInduction,
                                   {}},
                      why);
    triads_.push_back(triad);
  }

  // -------------------------------------------------------------------------------------------------------
  // acting

  bool Fits(const Triad& triad, const Step& step) const {
    if (triad.command != step.command) return false;
    if (step.command == "move") return true;
    if (triad.size != SizeOf(step.object)) return false;
    return triad.derived || ShapeOf(step.object) == "cube";
  }

  void Act(const Step& step) {
    const Place from = places_["h"];
    const Place to = places_[step.object];
    std::vector<Term> arguments = {Entity("h")};
    if (step.command == "move") arguments.push_back(Point(to.x - from.x, to.y - from.y));
    last_command_ = MakeCommand(Word(step.command.c_str()), std::move(arguments));
    const bool agent = frame_ >= 7;
    std::vector<EventId> why;
    if (!step.drive.empty()) Desire(step);
    if (agent) why = {Plan(step)};
    command_event_ = Emit(CommandIssued{last_command_,
                                        agent ? Commander::kAgent : Commander::kTeacher,
                                        agent ? drive_ : GoalId{},
                                        {now_ + kCommandDelay, now_ + kPeriod}},
                          why);
    Predict(step);
    Move(step, to);
  }

  void Move(const Step& step, Place to) {
    if (step.command == "move") {
      places_["h"] = to;
    } else if (step.command == "release") {
      held_.clear();
    } else if (!(options_.cylinder_slips && step.object == options_.cylinder)) {
      held_ = step.object;
    }
  }

  void Desire(const Step& step) {
    wanted_ = step.drive == "hold nothing" ? "" : step.object;
    drive_ = GoalId{NextObject()};
    ++drives_;
    const Term held = Term::Set(wanted_.empty() ? std::vector<Term>{} : std::vector<Term>{Entity(wanted_)});
    const Time deadline = now_ + kPeriod * 4;
    drive_event_ = Emit(
        DriveInjected{
            drive_, step.drive, {true, MakeValue(Entity("h"), Word("holding"), held), {now_, deadline}, 1}},
        {});
    goal_event_ = drive_event_;
  }

  // Backward chaining, comparison where nothing fits fully, simulation, commitment.
  EventId Plan(const Step& step) {
    std::string grasp = step.command;
    if (step.command == "move") grasp = SizeOf(step.object) == "small" ? "grab_type_1" : "grab_type_2";
    Step aim = step;
    aim.command = grasp;
    if (!step.drive.empty()) {
      const GoalId goal{NextObject()};
      goal_event_ = Emit(GoalSet{goal,
                                 drive_,
                                 causal_[grasp],
                                 {true,
                                  MakeImdl(causal_[grasp], {}, {Entity("h"), Entity(step.object)}),
                                  {now_, now_ + kPeriod * 3},
                                  1}},
                         {drive_event_});
      if (std::none_of(triads_.begin(), triads_.end(), [&](const Triad& t) { return Fits(t, aim); }))
        Compare(goal, aim);
      if (step.command == "move") {
        goal_event_ = Emit(GoalSet{GoalId{NextObject()},
                                   goal,
                                   causal_["move"],
                                   {true,
                                    MakeValue(Entity("h"), Word("position"),
                                              Point(places_[step.object].x, places_[step.object].y)),
                                    {now_ + kPeriod, now_ + kPeriod * 2},
                                    1}},
                           {goal_event_});
      }
    }
    return Simulate(step, aim);
  }

  EventId Simulate(const Step& step, const Step& aim) {
    const SimulationId simulation{NextObject()};
    std::vector<PlanStep> plan;
    double score = 1;
    std::vector<EventId> why = {goal_event_};
    const auto add = [&](const Step& s) {
      const auto triad =
          std::find_if(triads_.begin(), triads_.end(), [&](const Triad& t) { return Fits(t, s); });
      if (triad == triads_.end()) return;
      plan.push_back(
          {MakeCommand(Word(s.command.c_str()), {Entity("h")}), triad->causal, triad->requirement});
      score *= triad->evidence.rate();
      if (triad->made != goal_event_) why.push_back(triad->made);
    };
    add(step);
    if (step.command == "move") add(aim);
    const Time then = now_ + kPeriod * static_cast<std::int64_t>(plan.size());
    const EventId started = Emit(SimulationStarted{simulation, drive_, plan, score}, why);
    const EventId ended = Emit(SimulationEnded{simulation, SimulationOutcome::kReached}, {started});
    return Emit(PlanCommitted{drive_, simulation, {{simulation, score, score, then, then}}, score},
                {ended, goal_event_});
  }

  // Compares every requirement of the aimed-at effect with the object; the best familiar one is generalised.
  void Compare(GoalId goal, const Step& aim) {
    const std::vector<Triad> known = triads_;
    for (const Triad& triad : known) {
      const bool grasp = triad.command.starts_with("grab");
      if (triad.command == "move" || grasp != aim.command.starts_with("grab")) continue;
      CompareOne(goal, aim, triad);
    }
  }

  void CompareOne(GoalId goal, const Step& aim, const Triad& triad) {
    AnalogyCompared compared;
    compared.goal = goal;
    compared.requirement = triad.requirement;
    compared.source = triad.state;
    compared.causal_model = triad.causal;
    compared.bindings = MakeIcst(triad.state, {}, {Entity("h"), Entity(aim.object), V(4)});
    compared.total = static_cast<std::int64_t>(triad.conditions.size());
    std::vector<EventId> why = {goal_event_, triad.made};
    std::vector<Term> kept;
    for (std::size_t i = 0; i < triad.conditions.size(); ++i) {
      ComparedComponent component = CompareCondition(i, triad.conditions[i], aim, &why);
      if (component.status == ComponentStatus::kMatched) {
        ++compared.matched;
        kept.push_back(triad.conditions[i]);
      }
      compared.components.push_back(std::move(component));
    }
    const auto total = static_cast<double>(compared.total);
    const auto matched = static_cast<double>(compared.matched);
    compared.psi = matched / total;
    compared.jaccard = matched / (total + total - matched);
    compared.confidence = compared.psi * triad.evidence.rate();
    const bool familiar = compared.psi > 0.5;
    const bool required =
        std::none_of(triads_.begin(), triads_.end(), [&](const Triad& t) { return Fits(t, aim); });
    compared.verdict = !familiar   ? AnalogyVerdict::kNotFamiliar
                       : !required ? AnalogyVerdict::kNotRequired
                                   : AnalogyVerdict::kAccepted;
    if (compared.verdict == AnalogyVerdict::kAccepted) {
      compared.result_state = CompositeStateId{NextObject()};
      compared.result_requirement = ModelId{NextObject()};
    }
    const EventId comparison = Emit(compared, why);
    if (compared.verdict == AnalogyVerdict::kAccepted)
      Generalise(compared, triad, std::move(kept), comparison);
  }

  ComparedComponent CompareCondition(std::size_t index, const Term& condition, const Step& aim,
                                     std::vector<EventId>* why) {
    Bindings bindings;
    bindings.Set(0, Entity("h"));
    bindings.Set(3, Entity(aim.object));
    ComparedComponent result{
        static_cast<std::int64_t>(index), Substitute(condition, bindings), ComponentStatus::kMatched, {}, {}};
    std::pair<FactId, EventId> fact;
    const Place at = places_[aim.object];
    if (IsIcst(condition) && condition[0].composite_state() == s4_) {
      fact = properties_[aim.object + " size"];
      const std::string size = SizeOf(aim.object);
      result.counterpart = MakeIcst(s4_, {}, {Entity(aim.object), Word(size.c_str()), Point(at.x, at.y)});
      if (condition[2][1].name() != size) result.status = ComponentStatus::kMissed;
    } else if (IsIcst(condition)) {
      fact = seen_["h position"];
      result.counterpart = MakeIcst(s0_, {}, {Entity("h"), Point(places_["h"].x, places_["h"].y)});
    } else if (condition[1].name() == "shape") {
      fact = properties_[aim.object + " shape"];
      result.counterpart = MakeValue(Entity(aim.object), Word("shape"), Word(ShapeOf(aim.object).c_str()));
      if (condition[2].name() != ShapeOf(aim.object)) result.status = ComponentStatus::kMissed;
    } else {
      fact = seen_["h holding"];
      result.counterpart = MakeValue(Entity("h"), Word("holding"), Holding());
    }
    if (result.status == ComponentStatus::kMatched) result.found = fact.first;
    if (std::find(why->begin(), why->end(), fact.second) == why->end()) why->push_back(fact.second);
    return result;
  }

  void Generalise(const AnalogyCompared& compared, const Triad& source, std::vector<Term> kept,
                  EventId comparison) {
    Triad triad = source;
    triad.state = compared.result_state;
    triad.requirement = compared.result_requirement;
    triad.conditions = std::move(kept);
    triad.evidence = {compared.confidence, 1};
    triad.derived = true;
    const EventId state_made =
        Emit(CompositeStateCreated{StateOf(triad.state, triad.conditions), Origin::kAnalogy, source.state},
             {comparison});
    triad.made = Emit(ModelCreated{Requirement(triad.requirement, triad.command, triad.state, triad.causal),
                                   triad.evidence, false, Origin::kAnalogy, source.requirement},
                      {comparison, state_made});
    triads_.push_back(triad);
    goal_event_ = triad.made;
  }

  // The best known requirement that holds lets its causal model fire on the command just issued.
  void Predict(const Step& step) {
    const auto triad =
        std::find_if(triads_.begin(), triads_.end(), [&](const Triad& t) { return Fits(t, step); });
    if (triad == triads_.end()) return;
    used_ = static_cast<std::size_t>(triad - triads_.begin());
    const bool move = step.command == "move";
    const Place hand = places_["h"];
    const Place goal = places_[step.object];
    const Term target =
        move ? MakeValue(Entity("h"), Word("position"), Point(goal.x, goal.y))
             : MakeValue(Entity("h"), Word("holding"),
                         Term::Set(step.command == "release" ? std::vector<Term>{}
                                                             : std::vector<Term>{Entity(step.object)}));
    std::vector<Term> arguments = {Entity("h")};
    if (!move) arguments.push_back(Entity(step.object));
    arguments.push_back(Point(hand.x, hand.y));
    std::vector<EventId> parts = {seen_["h position"].second, seen_["h holding"].second};
    if (!move) parts.push_back(properties_[step.object + " size"].second);
    const FactId icst{NextObject()};
    const EventId found =
        Emit(IcstFound{icst, {true, MakeIcst(triad->state, {}, std::move(arguments)), Frame(), 1}}, parts);
    const FactId imdl{NextObject()};
    const Term instance =
        MakeImdl(triad->causal, {}, {Entity("h"), move ? last_command_[1][1] : Entity(step.object)});
    const EventId enabled =
        Emit(ImdlPredicted{imdl, triad->requirement, {true, instance, Frame(), triad->evidence.rate()}},
             {found, triad->made});
    prediction_ = PredictionId{NextObject()};
    prediction_event_ = Emit(
        PredictionMade{
            prediction_,
            triad->causal,
            {triad->requirement},
            FactId{},
            {true, target, {now_ + kPeriod, now_ + kPeriod * 2}, causal_evidence_[triad->causal].rate()}},
        {enabled, command_event_});
  }

  PaperEpisodeOptions options_;
  std::vector<Event> events_;
  Time now_;
  std::int64_t frame_ = 0;
  std::int64_t simulation_ = 0;
  std::int64_t objects_ = 0;
  std::map<std::string, Place> places_;
  std::string held_;
  std::map<std::string, std::pair<FactId, EventId>> seen_, before_, properties_;
  CompositeStateId s0_, s3_, s4_;
  EventId s0_event_, s3_event_, s4_event_;
  std::vector<Triad> triads_;
  std::map<std::string, ModelId> causal_;
  std::map<ModelId, Evidence> causal_evidence_;
  std::size_t used_ = 0;
  PredictionId prediction_;
  EventId prediction_event_;
  Term last_command_;
  EventId command_event_;
  GoalId drive_;
  EventId drive_event_, goal_event_;
  std::string wanted_;
  std::int64_t drives_ = 0, drives_reached_ = 0;
};

}  // namespace

std::vector<Event> PaperEpisode(const PaperEpisodeOptions& options) {
  return Author(options).Write();
}

}  // namespace aerascope
