#include "engine/world/mujoco_binding.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/base/text.h"

namespace aerascope {
namespace {

struct NamedKind {
  mjtObj type;
  const char* noun;
  int count;
};

std::vector<std::string> NamesOf(const mjModel& model, const NamedKind& kind) {
  std::vector<std::string> names;
  for (int id = 0; id < kind.count; ++id) {
    const char* name = mj_id2name(&model, kind.type, id);
    if (name && *name) names.emplace_back(name);
  }
  return names;
}

// The id of a named part; the error says where the name was given and which names there are.
Result<int> FindPart(const mjModel& model, const NamedKind& kind, const std::string& name,
                     const std::string& setting) {
  const int id = mj_name2id(&model, kind.type, name.c_str());
  if (id >= 0 && !name.empty()) return id;
  const std::vector<std::string> names = NamesOf(model, kind);
  const std::string closest = ClosestWord(name, names);
  std::string message =
      setting + ": expected the name of a " + kind.noun + " of the model, found '" + Printable(name) + "'";
  if (!closest.empty()) return Error{message + "; did you mean '" + closest + "'?"};
  if (names.empty()) return Error{message + "; the model names no " + kind.noun};
  return Error{message + "; the model has " + Join(names, ", ")};
}

NamedKind Sites(const mjModel& model) {
  return {mjOBJ_SITE, "site", model.nsite};
}
NamedKind Joints(const mjModel& model) {
  return {mjOBJ_JOINT, "joint", model.njnt};
}
NamedKind Bodies(const mjModel& model) {
  return {mjOBJ_BODY, "body", model.nbody};
}
NamedKind Actuators(const mjModel& model) {
  return {mjOBJ_ACTUATOR, "actuator", model.nu};
}

bool IsPositionServo(const mjModel& model, int actuator) {
  const mjtNum* gain = model.actuator_gainprm + mjNGAIN * actuator;
  const mjtNum* bias = model.actuator_biasprm + mjNBIAS * actuator;
  return model.actuator_dyntype[actuator] == mjDYN_NONE &&
         model.actuator_gaintype[actuator] == mjGAIN_FIXED &&
         model.actuator_biastype[actuator] == mjBIAS_AFFINE && gain[0] > 0 && bias[0] == 0 &&
         bias[1] == -gain[0] && model.actuator_gear[6 * actuator] != 0;
}

Result<ArmJoint> BindArmJoint(const mjModel& model, const std::string& name) {
  const Result<int> joint = FindPart(model, Joints(model), name, "arm_joints");
  if (!joint) return joint.error();
  const int type = model.jnt_type[*joint];
  if (type != mjJNT_HINGE && type != mjJNT_SLIDE) {
    return Error{"arm_joints: expected '" + name + "' to be a hinge or a slide, found a ball or free joint"};
  }
  int found = -1;
  for (int actuator = 0; actuator < model.nu; ++actuator) {
    const bool drives_it =
        model.actuator_trntype[actuator] == mjTRN_JOINT && model.actuator_trnid[2 * actuator] == *joint;
    if (!drives_it) continue;
    if (found >= 0)
      return Error{"arm_joints: expected one actuator for the joint '" + name + "', found several"};
    found = actuator;
  }
  if (found < 0)
    return Error{"arm_joints: expected a position actuator for the joint '" + name + "', found none"};
  if (!IsPositionServo(model, found)) {
    return Error{"arm_joints: expected the actuator of the joint '" + name +
                 "' to be a <position> actuator, found another kind"};
  }
  return ArmJoint{*joint,
                  model.jnt_qposadr[*joint],
                  model.jnt_dofadr[*joint],
                  found,
                  model.actuator_gainprm[mjNGAIN * found],
                  model.actuator_gear[6 * found]};
}

// Marks the body and everything attached to it.
void MarkSubtree(const mjModel& model, int root, int mark, std::vector<int>& marks) {
  marks[root] = mark;
  for (int body = root + 1; body < model.nbody; ++body) {
    if (marks[model.body_parentid[body]] == mark) marks[body] = mark;  // parents come before children
  }
}

Result<BoundObject> BindObject(const mjModel& model, const ObjectConfig& object) {
  const std::string setting = "object " + object.entity;
  const Result<int> body = FindPart(model, Bodies(model), object.body, setting);
  if (!body) return body.error();
  const bool is_free =
      model.body_jntnum[*body] == 1 && model.jnt_type[model.body_jntadr[*body]] == mjJNT_FREE;
  if (!is_free)
    return Error{setting + ": expected the body '" + object.body + "' to have a free joint and no other"};
  return BoundObject{*body, model.jnt_qposadr[model.body_jntadr[*body]]};
}

Status CheckNames(const MujocoWorldConfig& config) {
  std::set<std::string> entities;
  if (config.hand.entity.empty()) return Error{"hand: expected the name of an entity, found none"};
  entities.insert(config.hand.entity);
  for (const ObjectConfig& object : config.objects) {
    if (object.entity.empty()) return Error{"objects: expected the name of an entity, found none"};
    if (!entities.insert(object.entity).second)
      return Error{"objects: the entity '" + object.entity + "' is given twice"};
  }
  std::set<std::string> commands;
  for (const MotionCommand& command : config.commands) {
    if (command.name.empty()) return Error{"commands: expected a name, found none"};
    if (!commands.insert(command.name).second)
      return Error{"commands: '" + command.name + "' is given twice"};
  }
  return Ok();
}

bool Within(double value, double low, double high) {
  return value >= low && value <= high;
}  // false for NaN

Status CheckNumbers(const MujocoWorldConfig& config) {
  const auto expected = [](const std::string& what, double found) {
    return Error{what + ", found " + FormatNumber(found)};
  };
  const SensorConfig& sensors = config.sensors;
  if (!Within(sensors.resolution_m, 1e-6, 1))
    return expected("sensors: expected a resolution of 0.000001 to 1 m", sensors.resolution_m);
  if (!Within(sensors.object_deadband_m, sensors.resolution_m / 2, 1)) {
    return expected("sensors: expected an object deadband of at least half the resolution",
                    sensors.object_deadband_m);
  }
  const MotionConfig& motion = config.motion;
  if (!Within(motion.grasp_height_m, -10, 10))
    return expected("motion: expected a grasp height within 10 m", motion.grasp_height_m);
  if (!Within(motion.table_height_m, -10, 10))
    return expected("motion: expected a table height within 10 m", motion.table_height_m);
  if (!(motion.hover_height_m > motion.grasp_height_m) || !Within(motion.hover_height_m, -10, 10)) {
    return expected("motion: expected a hover height above the grasp height", motion.hover_height_m);
  }
  for (int axis = 0; axis < 2; ++axis) {
    if (!(motion.workspace_min_m[axis] < motion.workspace_max_m[axis])) {
      return expected("motion: expected workspace_max above workspace_min", motion.workspace_max_m[axis]);
    }
    if (!Within(config.hand.home_position_m[axis], motion.workspace_min_m[axis],
                motion.workspace_max_m[axis])) {
      return expected("hand: expected a home position inside the workspace",
                      config.hand.home_position_m[axis]);
    }
  }
  if (!Within(motion.max_tool_speed_m_per_s, 1e-3, 100))
    return expected("motion: expected a speed limit of 0.001 to 100 m/s", motion.max_tool_speed_m_per_s);
  if (!Within(motion.contact_stop_m, 1e-4, 1))
    return expected("motion: expected contact_stop of 0.0001 to 1 m", motion.contact_stop_m);
  if (!Within(motion.settle_s, 0, 60))
    return expected("motion: expected a settling time of 0 to 60 s", motion.settle_s);
  if (!Within(config.recorded_states_per_s, 0.1, 1000))
    return expected("expected 0.1 to 1000 recorded states per second", config.recorded_states_per_s);
  if (!Within(config.noise.position_m, 0, 1))
    return expected("noise: expected a position noise of 0 to 1 m", config.noise.position_m);
  if (!Within(config.noise.yaw_rad, 0, 4))
    return expected("noise: expected a yaw noise of 0 to 4 rad", config.noise.yaw_rad);
  if (!Within(config.noise.min_distance_m, 0, 10))
    return expected("noise: expected a least distance of 0 to 10 m", config.noise.min_distance_m);
  if (!Within(config.hand.start_gap_m, 0, 1))
    return expected("hand: expected a start gap of 0 to 1 m", config.hand.start_gap_m);
  if (!Within(config.hand.tool_yaw_rad, -10, 10))
    return expected("hand: expected a tool yaw within 10 rad", config.hand.tool_yaw_rad);
  for (const MotionCommand& command : config.commands) {
    if (command.kind == CommandKind::kMove) continue;
    if (!Within(command.open_gap_m, 0, 1))
      return expected("command " + command.name + ": expected an open gap of 0 to 1 m", command.open_gap_m);
    if (command.kind == CommandKind::kGrab &&
        !(Within(command.closed_gap_m, 0, 1) && command.closed_gap_m < command.open_gap_m)) {
      return expected("command " + command.name + ": expected a closed gap below the open gap",
                      command.closed_gap_m);
    }
  }
  return Ok();
}

Status CheckHand(const MujocoWorldConfig& config) {
  const HandConfig& hand = config.hand;
  if (hand.arm_joints.size() < 3)
    return Error{"arm_joints: expected at least 3 joints, found " + std::to_string(hand.arm_joints.size())};
  if (std::set<std::string>(hand.arm_joints.begin(), hand.arm_joints.end()).size() !=
      hand.arm_joints.size()) {
    return Error{"arm_joints: a joint is given twice"};
  }
  if (!hand.home_posture.empty() && hand.home_posture.size() != hand.arm_joints.size()) {
    return Error{"home_posture: expected " + std::to_string(hand.arm_joints.size()) +
                 " joint values, found " + std::to_string(hand.home_posture.size())};
  }
  if (hand.finger_bodies.size() < 2)
    return Error{"finger_bodies: expected at least 2, found " + std::to_string(hand.finger_bodies.size())};
  if (hand.finger_actuators.empty()) return Error{"finger_actuators: expected at least one, found none"};
  return Ok();
}

}  // namespace

Result<MujocoBinding> BindModel(const mjModel& model, const MujocoWorldConfig& config) {
  for (const Status& status : {CheckNames(config), CheckNumbers(config), CheckHand(config)}) {
    if (!status) return status.error();
  }
  MujocoBinding binding;
  const Result<int> site = FindPart(model, Sites(model), config.hand.tool_site, "tool_site");
  if (!site) return site.error();
  binding.tool_site = *site;
  for (const std::string& name : config.hand.arm_joints) {
    const Result<ArmJoint> joint = BindArmJoint(model, name);
    if (!joint) return joint.error();
    binding.arm.push_back(*joint);
  }
  for (const FingerActuator& finger : config.hand.finger_actuators) {
    const Result<int> actuator = FindPart(model, Actuators(model), finger.actuator, "finger_actuators");
    if (!actuator) return actuator.error();
    binding.finger_actuators.push_back(*actuator);
  }
  binding.finger_of_body.assign(model.nbody, -1);
  for (std::size_t i = 0; i < config.hand.finger_bodies.size(); ++i) {
    const Result<int> body = FindPart(model, Bodies(model), config.hand.finger_bodies[i], "finger_bodies");
    if (!body) return body.error();
    MarkSubtree(model, *body, static_cast<int>(i), binding.finger_of_body);
  }
  binding.object_of_body.assign(model.nbody, -1);
  for (std::size_t i = 0; i < config.objects.size(); ++i) {
    const Result<BoundObject> object = BindObject(model, config.objects[i]);
    if (!object) return object.error();
    if (binding.object_of_body[object->body] >= 0) {
      return Error{"object " + config.objects[i].entity + ": the body '" + config.objects[i].body +
                   "' is another object already"};
    }
    binding.objects.push_back(*object);
    MarkSubtree(model, object->body, static_cast<int>(i), binding.object_of_body);
  }
  return binding;
}

}  // namespace aerascope
