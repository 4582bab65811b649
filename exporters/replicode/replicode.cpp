#include "exporters/replicode/replicode.h"

#include <ostream>

#include "engine/replicode/writer.h"
#include "exporters/escape/escape.h"

namespace aerascope {

Status WriteKnowledgeAsReplicode(const KnowledgeBase& knowledge, std::ostream& out) {
  const Result<std::string> text = WriteReplicode(SeedFrom(knowledge));
  if (!text) return text.error();
  out << *text;
  out.flush();
  return StatusOf(out, "the Replicode export");
}

}  // namespace aerascope
