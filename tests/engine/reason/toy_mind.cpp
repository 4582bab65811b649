#include "tests/engine/reason/toy_mind.h"

namespace aerascope::toy {

CompositeState State(std::int64_t id, std::vector<Term> payloads, int after) {
  CompositeState state;
  state.id = CompositeStateId{id};
  for (Term& payload : payloads)
    state.components.push_back({true, std::move(payload), V(after), V(after + 1)});
  return state;
}

Model Causal(std::int64_t id, Term lhs, Term rhs, int frames) {
  Model model;
  model.id = ModelId{id};
  model.template_arguments = {Term::Struct("ti", {V(0), V(1)})};
  model.lhs = {true, std::move(lhs), V(4), V(5)};
  model.rhs = {true, std::move(rhs), V(6), V(7)};
  const Term later = Term::Span(kFrame * frames);
  model.forward = {{6, Term::Struct("+", {V(0), later})}, {7, Term::Struct("+", {V(1), later})}};
  model.backward = {{0, Term::Struct("-", {V(6), later})}, {1, Term::Struct("-", {V(7), later})}};
  return model;
}

Model Free(std::int64_t id, Term lhs, Term rhs) {
  Model model;
  model.id = ModelId{id};
  const bool command = IsCommand(lhs);
  model.lhs = {true, std::move(lhs), V(4), V(5)};
  model.rhs = {true, std::move(rhs), V(6), V(7)};
  // A command starts 20 ms into its frame.
  const Term after = Term::Span(command ? Milliseconds(80) : kFrame);
  const Term before = Term::Span(kFrame);
  model.forward = {{6, Term::Struct("+", {V(4), after})}, {7, Term::Struct("+", {V(5), before})}};
  model.backward = {{4, Term::Struct("-", {V(6), after})}, {5, Term::Struct("-", {V(7), before})}};
  return model;
}

Model Requires(std::int64_t id, Term condition, const Model& model, std::vector<Term> exposed, int after,
               bool positive) {
  Model requirement;
  requirement.id = ModelId{id};
  requirement.lhs = {true, std::move(condition), V(after), V(after + 1)};
  std::vector<Term> given;
  if (!model.template_arguments.empty()) given = {Term::Struct("ti", {V(after), V(after + 1)})};
  requirement.rhs = {positive, MakeImdl(model.id, std::move(given), std::move(exposed)), V(after),
                     V(after + 1)};
  return requirement;
}

void ToyMind::Know(const std::vector<Term>& properties, const std::vector<CompositeState>& states,
                   const std::vector<SeedModelDefinition>& models) {
  std::vector<Fact> facts;
  for (const Term& property : properties) facts.push_back({true, property, kAlways, 1});
  reasoner.LoadSeed({}, facts, states, models);
}

void ToyMind::See(const std::vector<Term>& payloads) {
  ++frame_;
  const TimeInterval interval{Time{frame_ * kFrame.us}, Time{(frame_ + 1) * kFrame.us}};
  std::vector<Fact> facts;
  for (const Term& payload : payloads) facts.push_back({true, payload, interval, 1});
  reasoner.BeginFrame(frame_, facts);
}

void ToyMind::Want(const Term& goal, int frames, bool positive, double confidence) {
  reasoner.SetDrive(ToText(goal), goal, Time{(frame_ + frames) * kFrame.us}, positive, confidence);
}

std::string ToyMind::Act() {
  const auto wish = reasoner.Decide();
  if (!wish) return "";
  reasoner.Executed(wish->command,
                    reasoner.CommandIssued(wish->command, Commander::kAgent, wish->drive, wish->event));
  return ToText(wish->command);
}

std::string ToyMind::Wish() {
  const auto wish = reasoner.Decide();
  return wish ? ToText(wish->command) : "";
}

}  // namespace aerascope::toy
