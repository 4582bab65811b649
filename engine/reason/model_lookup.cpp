#include "engine/reason/model_lookup.h"

namespace aerascope {
namespace {

std::vector<ModelId> Scan(const KnowledgeBase& knowledge, const Term& payload, FactPattern Model::*side) {
  std::vector<ModelId> found;
  for (const auto& [id, record] : knowledge.models()) {
    if (record.state == ModelState::kDeleted) continue;
    Bindings bindings;
    if (Match((record.model.*side).payload, payload, bindings)) found.push_back(id);
  }
  return found;
}

}  // namespace

std::vector<ModelId> CandidatesByRhs(const KnowledgeBase& knowledge, const Term& payload) {
  return Scan(knowledge, payload, &Model::rhs);
}

std::vector<ModelId> CandidatesByLhs(const KnowledgeBase& knowledge, const Term& payload) {
  return Scan(knowledge, payload, &Model::lhs);
}

}  // namespace aerascope
