#include "engine/reason/existence.h"

namespace aerascope {

const ModelRecord* FindEqual(const Model& model, const KnowledgeBase& knowledge) {
  const ModelRecord* record = knowledge.Find(knowledge.FindModel(knowledge.CanonicalOf(model).hash));
  if (!record || (record->state == ModelState::kDeleted && !record->black_listed)) return nullptr;
  return record;
}

ModelInstance InTermsOf(const ModelRecord& known, const ModelInstance& instance,
                        const KnowledgeBase& knowledge) {
  const Canonical canonical = knowledge.CanonicalOf(instance.model);
  ModelInstance same{known.model, {}};
  for (std::size_t i = 0; i < canonical.variables.size(); ++i) {
    if (const Term* value = instance.values.Find(canonical.variables[i])) {
      same.values.Set(known.canonical.variables[i], *value);
    }
  }
  return same;
}

}  // namespace aerascope
