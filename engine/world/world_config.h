// What the configurations of all worlds share: static properties and kinds of commands, in plain words.
#pragma once

#include <string>
#include <vector>

#include "engine/base/time.h"
#include "engine/kb/fact.h"

namespace aerascope {

// A fact that never changes: (mk.val <entity> <attribute> <value>), attribute and value being ontology
// symbols.
struct EntityProperty {
  std::string attribute;
  std::string value;

  bool operator==(const EntityProperty&) const = default;
};

// move [h delta]; grab [h]; release [h]; change [h], which alters what it acts on without holding it and
// exists in the scripted world only.
enum class CommandKind { kMove, kGrab, kRelease, kChange };

inline Fact PropertyFact(const std::string& entity, const EntityProperty& property) {
  return {true,
          MakeValue(Term::Entity(entity), Term::Ontology(property.attribute), Term::Ontology(property.value)),
          kAlways, 1};
}

}  // namespace aerascope
