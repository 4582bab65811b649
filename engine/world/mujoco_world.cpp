#include "engine/world/mujoco_world.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <random>

#include "engine/base/text.h"
#include "engine/world/arm_kinematics.h"
#include "engine/world/mujoco_binding.h"
#include "engine/world/mujoco_collisions.h"
#include "engine/world/mujoco_error.h"
#include "engine/world/mujoco_model.h"
#include "engine/world/position_sensor.h"

namespace aerascope {
namespace {

// How a grab and a release share their time: down, fingers, up; the rest is left for things to come to rest.
constexpr double kDownShare = 0.40;
constexpr double kFingerShare = 0.15;
constexpr double kUpShare = 0.34;
constexpr double kMoveShare = 0.80;
// The fingers open within this part of the way down.
constexpr double kOpeningShare = 0.4;
// The time in which the arm gives way when it meets something on its way down.
constexpr double kYieldSeconds = 0.06;
// The peak of a minimum-jerk motion over its mean speed.
constexpr double kPeakOverMean = 1.875;

double MinimumJerk(double t) {
  return t * t * t * (10 + t * (6 * t - 15));
}

double Distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

Term PlaneVector(std::array<double, 2> place) {
  return Term::Struct("vec2", {Term::Number(place[0]), Term::Number(place[1])});
}

// Uniform in [-1, 1), the same on every machine and with every standard library.
double Centred(std::mt19937_64& generator) {
  return static_cast<double>(generator() >> 11) * 0x1.0p-52 - 1.0;
}

class MujocoWorld final : public World {
 public:
  MujocoWorld(MujocoWorldConfig config, PackedModel packed, ModelPointer model, MujocoBinding binding)
      : config_(std::move(config)),
        packed_(std::move(packed)),
        model_(std::move(model)),
        data_(mj_makeData(model_.get())),
        binding_(std::move(binding)),
        kinematics_(*model_, binding_),
        hand_sensor_(config_.sensors.resolution_m, 0),
        object_sensors_(config_.objects.size(),
                        PositionSensor(config_.sensors.resolution_m, config_.sensors.object_deadband_m)) {}

  Status Begin();

  Result<std::vector<Fact>> Observe(TimeInterval frame) override;
  std::vector<Fact> Properties() const override;
  Result<ActOutcome> Act(std::span<const Term> commands, TimeInterval during) override;
  WorldState State() const override;
  WorldDescription Description() const override;

 private:
  // Where the tool and the fingers are meant to be.
  struct Reference {
    ToolPose tool;
    double gap_m = 0;
  };

  Status PlaceObjects();
  Status ReachHome();

  Time Now() const { return TimeAtStep(steps_); }
  Time TimeAtStep(std::int64_t step) const {
    return {std::llround(static_cast<double>(step) * model_->opt.timestep * 1e6)};
  }
  void Step(const Reference& next);
  void WaitUntil(Time time);
  bool Travel(const Reference& target, double duration_s, double gap_share, bool stop_on_contact);
  void Yield();
  Status CheckHealth();

  // Each gives the command as it was carried out, or nothing and a note.
  std::optional<Term> Carry(const Term& command, double duration_s);
  std::optional<Term> CarryMove(const Term& command, const Term& delta, double duration_s);
  std::optional<Term> CarryGrab(const Term& command, const MotionCommand& motion, double duration_s);
  std::optional<Term> CarryRelease(const Term& command, const MotionCommand& motion, double duration_s);
  std::optional<Term> Refuse(const Term& command, const std::string& reason);
  bool TooFast(double way_m, double duration_s) const;
  bool Reachable(const ToolPose& tool);
  double Height(double above_table_m) const { return config_.motion.table_height_m + above_table_m; }

  std::array<double, 2> ToolPlace() const;
  std::array<double, 2> ObjectPlace(std::size_t object) const;
  std::vector<std::size_t> HeldObjects() const;

  const MujocoWorldConfig config_;
  const PackedModel packed_;
  const ModelPointer model_;
  const DataPointer data_;
  const MujocoBinding binding_;
  ArmKinematics kinematics_;
  PositionSensor hand_sensor_;
  std::vector<PositionSensor> object_sensors_;

  std::int64_t steps_ = 0;  // since the episode began
  Reference reference_;
  std::vector<double> joints_;      // of the reference
  std::vector<double> velocities_;  // of the reference
  ActOutcome* outcome_ = nullptr;   // where the running Act collects states and notes
};

// --- beginning
// ------------------------------------------------------------------------------------------------------

Status MujocoWorld::Begin() {
  if (Status status = PlaceObjects(); !status) return status;
  if (Status status = ReachHome(); !status) return status;
  const auto settling = std::llround(config_.motion.settle_s / model_->opt.timestep);
  for (long long i = 0; i < settling; ++i) Step(reference_);
  steps_ = 0;
  data_->time = 0;
  hand_sensor_.Report(ToolPlace());
  for (std::size_t i = 0; i < object_sensors_.size(); ++i) object_sensors_[i].Report(ObjectPlace(i));
  return CheckHealth();
}

Status MujocoWorld::PlaceObjects() {
  constexpr int kTries = 1000;
  const PoseNoise& noise = config_.noise;
  std::mt19937_64 generator(noise.seed);
  for (std::size_t i = 0; i < config_.objects.size(); ++i) {
    mjtNum* pose = data_->qpos + binding_.objects[i].qpos_address;
    const std::array<double, 2> given{pose[0], pose[1]};
    const auto too_near = [&] {
      for (std::size_t k = 0; k < i; ++k) {
        const std::array<double, 2> other = ObjectPlace(k);
        if (std::hypot(pose[0] - other[0], pose[1] - other[1]) < noise.min_distance_m) return true;
      }
      return false;
    };
    double yaw = 0;
    int tries = 0;
    do {
      if (++tries > kTries) {
        return Error{"noise: expected a place for the object '" + config_.objects[i].entity + "' at least " +
                     FormatNumber(noise.min_distance_m) + " m from the others, found none in " +
                     std::to_string(kTries) +
                     " tries; move the objects apart in the model or lower min_distance_m"};
      }
      pose[0] = given[0] + noise.position_m * Centred(generator);
      pose[1] = given[1] + noise.position_m * Centred(generator);
      yaw = noise.yaw_rad * Centred(generator);
    } while (too_near());
    const mjtNum axis[3] = {0, 0, 1};
    mjtNum turn[4];
    mjtNum before[4];
    mju_axisAngle2Quat(turn, axis, yaw);
    mju_copy4(before, pose + 3);
    mju_mulQuat(pose + 3, turn, before);
  }
  return Ok();
}

Status MujocoWorld::ReachHome() {
  const HandConfig& hand = config_.hand;
  std::vector<double> start = hand.home_posture;
  if (start.empty()) {
    for (const ArmJoint& joint : binding_.arm) start.push_back(model_->qpos0[joint.qpos_address]);
  }
  reference_.tool = {
      {hand.home_position_m[0], hand.home_position_m[1], Height(config_.motion.hover_height_m)},
      hand.tool_yaw_rad};
  reference_.gap_m = hand.start_gap_m;
  const IkSolution solution = kinematics_.Solve(reference_.tool, start);
  if (!solution.reached()) {
    return Error{"hand: expected a home position that the arm can reach, found (" +
                 FormatNumber(hand.home_position_m[0]) + ", " + FormatNumber(hand.home_position_m[1]) +
                 "), which it misses by " + FormatNumber(solution.position_error_m, 3) + " m and " +
                 FormatNumber(solution.rotation_error_rad, 3) +
                 " rad; change home_position, hover_height, tool_yaw or home_posture"};
  }
  joints_ = solution.joints;
  velocities_.assign(joints_.size(), 0);
  for (std::size_t i = 0; i < joints_.size(); ++i) data_->qpos[binding_.arm[i].qpos_address] = joints_[i];
  mj_forward(model_.get(), data_.get());
  return Ok();
}

// --- motion
// ---------------------------------------------------------------------------------------------------------

// One step of physics towards the next reference. The servos get, besides the position, the force that the
// reference motion needs (inertia, gravity, damping), so that the arm follows without hanging back.
void MujocoWorld::Step(const Reference& next) {
  mjModel& model = *model_;
  mjData& data = *data_;
  const double dt = model.opt.timestep;
  if (!(next.tool == reference_.tool)) {
    const IkSolution solution = kinematics_.Solve(next.tool, joints_);
    std::vector<mjtNum> acceleration(model.nv, 0);
    std::vector<mjtNum> force(model.nv, 0);
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      const double velocity = (solution.joints[i] - joints_[i]) / dt;
      acceleration[binding_.arm[i].dof_address] = (velocity - velocities_[i]) / dt;
      velocities_[i] = velocity;
      joints_[i] = solution.joints[i];
    }
    mj_mulM(&model, &data, force.data(), acceleration.data());
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      const ArmJoint& joint = binding_.arm[i];
      const double push = force[joint.dof_address] + data.qfrc_bias[joint.dof_address] +
                          model.dof_damping[joint.dof_address] * velocities_[i];
      data.ctrl[joint.actuator] = joint.gear * joints_[i] + push / (joint.gear * joint.stiffness);
    }
  } else {
    std::fill(velocities_.begin(), velocities_.end(), 0);
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      const ArmJoint& joint = binding_.arm[i];
      data.ctrl[joint.actuator] =
          joint.gear * joints_[i] + data.qfrc_bias[joint.dof_address] / (joint.gear * joint.stiffness);
    }
  }
  for (std::size_t i = 0; i < binding_.finger_actuators.size(); ++i) {
    const FingerActuator& finger = config_.hand.finger_actuators[i];
    data.ctrl[binding_.finger_actuators[i]] =
        finger.control_at_zero_gap + finger.control_per_gap * next.gap_m;
  }
  reference_ = next;
  mj_step(&model, &data);
  ++steps_;

  if (!outcome_) return;
  const double period_us = 1e6 / config_.recorded_states_per_s;
  const auto periods = [&](Time time) {
    return std::floor((static_cast<double>(time.us) + 0.5) / period_us);
  };
  if (periods(Now()) > periods(TimeAtStep(steps_ - 1))) outcome_->states.push_back(State());
}

void MujocoWorld::WaitUntil(Time time) {
  while (TimeAtStep(steps_ + 1) <= time) Step(reference_);
}

// Moves the reference to the target on a straight line. The gap changes within the first part of the way.
// True if the way was cut short because the tool hung back: it stands on something.
bool MujocoWorld::Travel(const Reference& target, double duration_s, double gap_share, bool stop_on_contact) {
  const Reference from = reference_;
  const auto count = std::max<long long>(1, std::llround(duration_s / model_->opt.timestep));
  for (long long i = 1; i <= count; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(count);
    const double way = MinimumJerk(part);
    const double opening = MinimumJerk(std::min(1.0, part / gap_share));
    Reference next = target;
    if (i < count) {
      for (int k = 0; k < 3; ++k) {
        next.tool.position_m[k] =
            from.tool.position_m[k] + way * (target.tool.position_m[k] - from.tool.position_m[k]);
      }
      next.gap_m = from.gap_m + opening * (target.gap_m - from.gap_m);
    }
    Step(next);
    const double lag_m = data_->site_xpos[3 * binding_.tool_site + 2] - reference_.tool.position_m[2];
    if (stop_on_contact && lag_m > config_.motion.contact_stop_m) {
      Yield();
      return true;
    }
  }
  return false;
}

// Backs off to where the tool met the thing, and a little more, so that it no longer presses.
void MujocoWorld::Yield() {
  Reference here = reference_;
  here.tool.position_m[2] = data_->site_xpos[3 * binding_.tool_site + 2] + config_.motion.contact_stop_m;
  Travel(here, kYieldSeconds, 1, false);
}

bool MujocoWorld::TooFast(double way_m, double duration_s) const {
  return kPeakOverMean * way_m > config_.motion.max_tool_speed_m_per_s * duration_s;
}

bool MujocoWorld::Reachable(const ToolPose& tool) {
  return kinematics_.Solve(tool, joints_).reached();
}

// --- commands
// -------------------------------------------------------------------------------------------------------

std::optional<Term> MujocoWorld::Refuse(const Term& command, const std::string& reason) {
  outcome_->notes.push_back(ToText(command) + " was not carried out: " + reason);
  return std::nullopt;
}

std::optional<Term> MujocoWorld::Carry(const Term& command, double duration_s) {
  if (!IsCommand(command)) return Refuse(command, "expected (cmd name [hand ...])");
  const std::string& name = command[0].name();
  const auto motion = std::find_if(config_.commands.begin(), config_.commands.end(),
                                   [&](const MotionCommand& known) { return known.name == name; });
  if (motion == config_.commands.end()) return Refuse(command, "the world has no such command");
  const Term& arguments = command[1];
  const std::size_t expected = motion->kind == CommandKind::kMove ? 2 : 1;
  if (!arguments.is(TermKind::kSet) || arguments.size() != expected) {
    return Refuse(command,
                  "expected " + std::to_string(expected) + (expected == 1 ? " argument" : " arguments"));
  }
  if (arguments[0] != Term::Entity(config_.hand.entity)) {
    return Refuse(command, "expected the hand " + config_.hand.entity + " as first argument");
  }
  switch (motion->kind) {
    case CommandKind::kMove:
      return CarryMove(command, arguments[1], duration_s);
    case CommandKind::kGrab:
      return CarryGrab(command, *motion, duration_s);
    case CommandKind::kRelease:
      return CarryRelease(command, *motion, duration_s);
    case CommandKind::kChange:
      return Refuse(command, "there is no such kind of command among real things");
  }
  return std::nullopt;
}

std::optional<Term> MujocoWorld::CarryMove(const Term& command, const Term& delta, double duration_s) {
  const bool is_vector = delta.IsStruct("vec2") && delta.size() == 2 && delta[0].is(TermKind::kNumber) &&
                         delta[1].is(TermKind::kNumber) && std::isfinite(delta[0].number()) &&
                         std::isfinite(delta[1].number());
  if (!is_vector) return Refuse(command, "expected a delta (vec2 x y)");
  const std::array<double, 2> before = hand_sensor_.Report(ToolPlace());
  Reference target = reference_;
  target.tool.position_m[2] = Height(config_.motion.hover_height_m);
  bool clipped = false;
  for (int k = 0; k < 2; ++k) {
    const double wanted = reference_.tool.position_m[k] + delta[k].number();
    target.tool.position_m[k] =
        std::clamp(wanted, config_.motion.workspace_min_m[k], config_.motion.workspace_max_m[k]);
    clipped = clipped || std::abs(target.tool.position_m[k] - wanted) > 1e-9;
  }
  ToolPose down = target.tool;
  down.position_m[2] = Height(config_.motion.grasp_height_m);
  if (!Reachable(target.tool) || !Reachable(down)) return Refuse(command, "the arm cannot reach that place");
  const double way_m = Distance(target.tool.position_m, reference_.tool.position_m);
  if (TooFast(way_m, kMoveShare * duration_s))
    return Refuse(command, "the way is too long for the time it is given");

  const Time end = Now() + Duration{std::llround(duration_s * 1e6)};
  Travel(target, kMoveShare * duration_s, 1, false);
  WaitUntil(end);
  const std::array<double, 2> after = hand_sensor_.Report(ToolPlace());
  const double resolution_m = config_.sensors.resolution_m;
  const Term moved =
      PlaneVector({GridValue(std::llround((after[0] - before[0]) / resolution_m), resolution_m),
                   GridValue(std::llround((after[1] - before[1]) / resolution_m), resolution_m)});
  if (clipped)
    outcome_->notes.push_back(ToText(command) + " was cut to " + ToText(moved) +
                              ": the workspace ends there");
  return MakeCommand(command[0], {command[1][0], moved});
}

std::optional<Term> MujocoWorld::CarryGrab(const Term& command, const MotionCommand& motion,
                                           double duration_s) {
  if (!HeldObjects().empty()) return Refuse(command, "the hand holds something");
  const Reference hover = reference_;
  Reference down = hover;
  down.tool.position_m[2] = Height(config_.motion.grasp_height_m);
  down.gap_m = motion.open_gap_m;
  if (!Reachable(down.tool)) return Refuse(command, "the arm cannot reach the table there");
  if (TooFast(Distance(hover.tool.position_m, down.tool.position_m), kDownShare * duration_s)) {
    return Refuse(command, "the way down is too long for the time it is given");
  }
  const Time end = Now() + Duration{std::llround(duration_s * 1e6)};
  Travel(down, kDownShare * duration_s, kOpeningShare, true);
  Reference closed = reference_;
  closed.gap_m = motion.closed_gap_m;
  Travel(closed, kFingerShare * duration_s, 0.6, false);
  Reference up = hover;
  up.gap_m = motion.closed_gap_m;
  Travel(up, kUpShare * duration_s, 1, false);
  WaitUntil(end);
  return command;
}

std::optional<Term> MujocoWorld::CarryRelease(const Term& command, const MotionCommand& motion,
                                              double duration_s) {
  const Reference hover = reference_;
  const bool holds = !HeldObjects().empty();
  Reference down = hover;
  down.tool.position_m[2] = Height(config_.motion.grasp_height_m);
  if (holds && !Reachable(down.tool)) return Refuse(command, "the arm cannot reach the table there");
  if (holds && TooFast(Distance(hover.tool.position_m, down.tool.position_m), kDownShare * duration_s)) {
    return Refuse(command, "the way down is too long for the time it is given");
  }
  const Time end = Now() + Duration{std::llround(duration_s * 1e6)};
  if (holds) Travel(down, kDownShare * duration_s, 1, true);
  Reference open = reference_;
  open.gap_m = motion.open_gap_m;
  Travel(open, kFingerShare * duration_s, 1, false);
  Reference up = hover;
  up.gap_m = motion.open_gap_m;
  if (holds) Travel(up, kUpShare * duration_s, 1, false);
  WaitUntil(end);
  return command;
}

Result<ActOutcome> MujocoWorld::Act(std::span<const Term> commands, TimeInterval during) {
  if (during.before < Now()) {
    return Error{"the world is at " + ToText(Now()) + " and cannot act until " + ToText(during.before)};
  }
  ActOutcome outcome;
  outcome_ = &outcome;
  Status health = Ok();
  try {
    WaitUntil(during.after);
    const double available_s = static_cast<double>((during.before - std::max(Now(), during.after)).us) * 1e-6;
    for (const Term& command : commands) {
      const std::optional<Term> executed = Carry(command, available_s / static_cast<double>(commands.size()));
      if (executed) outcome.executed.push_back(*executed);
    }
    WaitUntil(during.before);
    health = CheckHealth();
  } catch (const std::exception& trouble) {
    health = Error{packed_.name + ": the physics stopped: " + Printable(trouble.what())};
  }
  outcome_ = nullptr;
  if (!health) return health.error();
  return outcome;
}

// MuJoCo answers a broken state with a warning and a silent reset; here it ends the episode.
Status MujocoWorld::CheckHealth() {
  TakeMujocoWarnings();
  for (const int warning : {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC, mjWARN_BADCTRL,
                            mjWARN_CONTACTFULL, mjWARN_CNSTRFULL}) {
    if (data_->warning[warning].number == 0) continue;
    return Error{packed_.name + ": the physics went wrong at " + ToText(Now()) + ": " +
                 Printable(mju_warningText(warning, data_->warning[warning].lastinfo))};
  }
  return Ok();
}

// --- sensors
// --------------------------------------------------------------------------------------------------------

std::array<double, 2> MujocoWorld::ToolPlace() const {
  const mjtNum* place = data_->site_xpos + 3 * binding_.tool_site;
  return {place[0], place[1]};
}

std::array<double, 2> MujocoWorld::ObjectPlace(std::size_t object) const {
  const mjtNum* pose = data_->qpos + binding_.objects[object].qpos_address;
  return {pose[0], pose[1]};
}

// The objects that every finger touches.
std::vector<std::size_t> MujocoWorld::HeldObjects() const {
  const std::size_t fingers = config_.hand.finger_bodies.size();
  std::vector<std::vector<bool>> touched(config_.objects.size(), std::vector<bool>(fingers, false));
  for (int i = 0; i < data_->ncon; ++i) {
    const mjContact& contact = data_->contact[i];
    if (contact.exclude != 0) continue;
    const int bodies[2] = {model_->geom_bodyid[contact.geom1], model_->geom_bodyid[contact.geom2]};
    for (int k = 0; k < 2; ++k) {
      const int finger = binding_.finger_of_body[bodies[k]];
      const int object = binding_.object_of_body[bodies[1 - k]];
      if (finger >= 0 && object >= 0) touched[object][finger] = true;
    }
  }
  std::vector<std::size_t> held;
  for (std::size_t object = 0; object < touched.size(); ++object) {
    if (std::find(touched[object].begin(), touched[object].end(), false) == touched[object].end())
      held.push_back(object);
  }
  return held;
}

Result<std::vector<Fact>> MujocoWorld::Observe(TimeInterval frame) {
  const SensorConfig& sensors = config_.sensors;
  const Term hand = Term::Entity(config_.hand.entity);
  const Term position = Term::Ontology(sensors.position_attribute);
  std::vector<Term> held;
  for (const std::size_t object : HeldObjects()) held.push_back(Term::Entity(config_.objects[object].entity));

  std::vector<Fact> facts;
  facts.push_back({true, MakeValue(hand, position, PlaneVector(hand_sensor_.Report(ToolPlace()))), frame, 1});
  facts.push_back({true,
                   MakeValue(hand, Term::Ontology(sensors.holding_attribute), Term::Set(std::move(held))),
                   frame, 1});
  for (std::size_t i = 0; i < config_.objects.size(); ++i) {
    const Term place = PlaneVector(object_sensors_[i].Report(ObjectPlace(i)));
    facts.push_back({true, MakeValue(Term::Entity(config_.objects[i].entity), position, place), frame, 1});
  }
  return facts;
}

std::vector<Fact> MujocoWorld::Properties() const {
  std::vector<Fact> facts;
  for (const EntityProperty& property : config_.hand.properties)
    facts.push_back(PropertyFact(config_.hand.entity, property));
  for (const ObjectConfig& object : config_.objects) {
    for (const EntityProperty& property : object.properties)
      facts.push_back(PropertyFact(object.entity, property));
  }
  return facts;
}

WorldState MujocoWorld::State() const {
  const mjModel& model = *model_;
  const mjData& data = *data_;
  return {Now(),
          {data.qpos, data.qpos + model.nq},
          {data.qvel, data.qvel + model.nv},
          {data.ctrl, data.ctrl + model.nu}};
}

WorldDescription MujocoWorld::Description() const {
  WorldDescription description{"mujoco", packed_.text, packed_.assets, {}};
  for (int camera = 0; camera < model_->ncam; ++camera) {
    const char* name = mj_id2name(model_.get(), mjOBJ_CAMERA, camera);
    if (name && *name) description.cameras.emplace_back(name);
  }
  for (const ObjectConfig& object : config_.objects) description.body_of_entity[object.entity] = object.body;
  const char* hand = mj_id2name(model_.get(), mjOBJ_BODY, model_->site_bodyid[binding_.tool_site]);
  if (hand && *hand) description.body_of_entity[config_.hand.entity] = hand;
  return description;
}

}  // namespace

Result<std::unique_ptr<World>> MakeMujocoWorld(const MujocoWorldConfig& config) {
  if (config.model_path.empty() == config.model_text.empty()) {
    return Error{"world: expected either the path of an MJCF model or its text, found " +
                 std::string(config.model_path.empty() ? "neither" : "both")};
  }
  InstallMujocoCollisionFixes();
  Result<PackedModel> packed = config.model_path.empty()
                                   ? PackModelText(config.model_text, config.model_assets)
                                   : PackModelFile(config.model_path);
  if (!packed) return packed.error();
  Result<ModelPointer> model = LoadModel(*packed);
  if (!model) return model.error();
  Result<MujocoBinding> binding = BindModel(**model, config);
  if (!binding) return Error{packed->name + ": " + binding.error().message};
  try {
    auto world = std::make_unique<MujocoWorld>(config, *packed, std::move(*model), std::move(*binding));
    if (Status status = world->Begin(); !status) return Error{packed->name + ": " + status.error().message};
    return std::unique_ptr<World>(std::move(world));
  } catch (const std::exception& trouble) {
    return Error{packed->name + ": the physics cannot start: " + Printable(trouble.what())};
  }
}

}  // namespace aerascope
