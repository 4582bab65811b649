#include "engine/event/event_packing.h"

#include <array>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace aerascope {
namespace {

// What a value is put together from, once for both directions. A body is put together from its fields.
auto Parts(auto& value) requires
    std::is_same_v<std::remove_const_t<std::remove_reference_t<decltype(value)>>, Fact> {
  return std::tie(value.positive, value.payload, value.interval, value.confidence);
}
auto Parts(auto& value) requires
    std::is_same_v<std::remove_const_t<std::remove_reference_t<decltype(value)>>, FactPattern> {
  return std::tie(value.positive, value.payload, value.after, value.before);
}
auto Parts(auto& value) requires
    std::is_same_v<std::remove_const_t<std::remove_reference_t<decltype(value)>>, Guard> {
  return std::tie(value.target, value.expression);
}
auto Parts(auto& value) requires
    std::is_same_v<std::remove_const_t<std::remove_reference_t<decltype(value)>>, CompositeState> {
  return std::tie(value.id, value.components, value.guards, value.variable_names);
}
auto Parts(auto& value) requires
    std::is_same_v<std::remove_const_t<std::remove_reference_t<decltype(value)>>, Model> {
  return std::tie(value.id, value.template_arguments, value.lhs, value.rhs, value.forward, value.backward,
                  value.variable_names);
}
template <class Value>
requires requires {
  std::remove_const_t<Value>::Fields();
}
auto Parts(Value& value) {
  return std::apply([&](const auto&... field) { return std::tie(value.*(field.member)...); },
                    std::remove_const_t<Value>::Fields());
}

struct Packing {
  TermPacker& terms;
  PackedBytes* to;

  template <class T>
  void operator()(const T& value) const {
    if constexpr (std::is_same_v<T, Term>) {
      terms.Pack(value, to);
    } else if constexpr (std::is_same_v<T, std::string>) {
      to->PutText(value);
    } else if constexpr (kIsVector<T>) {
      to->Put(static_cast<std::uint32_t>(value.size()));
      if constexpr (std::is_trivially_copyable_v<typename T::value_type>) {
        to->PutBytes(value.data(), value.size() * sizeof(typename T::value_type));
      } else {
        for (const auto& element : value) (*this)(element);
      }
    } else if constexpr (std::is_trivially_copyable_v<T>) {
      to->Put(value);
    } else {
      std::apply([&](const auto&... part) { ((*this)(part), ...); }, Parts(value));
    }
  }
};

struct Unpacking {
  TermUnpacker& terms;
  PackedReader* from;

  template <class T>
  void operator()(T& value) const {
    if constexpr (std::is_same_v<T, Term>) {
      value = terms.Unpack(from);
    } else if constexpr (std::is_same_v<T, std::string>) {
      value = from->GetText();
    } else if constexpr (kIsVector<T>) {
      value.resize(from->Get<std::uint32_t>());
      if constexpr (std::is_trivially_copyable_v<typename T::value_type>) {
        const std::size_t bytes = value.size() * sizeof(typename T::value_type);
        if (bytes > 0) std::memcpy(value.data(), from->Skip(bytes), bytes);
      } else {
        for (auto& element : value) (*this)(element);
      }
    } else if constexpr (std::is_trivially_copyable_v<T>) {
      value = from->Get<T>();
    } else {
      std::apply([&](auto&... part) { ((*this)(part), ...); }, Parts(value));
    }
  }
};

// For each kind, by its position in EventBody: an empty body of it.
EventBody EmptyBody(std::size_t kind) {
  using Make = EventBody (*)();
  static constexpr auto kMakers = []<std::size_t... I>(std::index_sequence<I...>) {
    return std::array<Make, kEventKinds>{[]() { return EventBody(std::in_place_index<I>); }...};
  }
  (std::make_index_sequence<kEventKinds>());
  return kMakers[kind]();
}

}  // namespace

void EventPacker::Pack(const Event& event, PackedBytes* to) {
  const Packing pack{terms_, to};
  to->Put(static_cast<std::uint8_t>(event.body.index()));
  static_assert(kEventKinds <= 256);
  pack(event.id);
  pack(event.time);
  pack(event.frame);
  pack(event.simulation);
  pack(event.causes);
  std::visit(pack, event.body);
  to->Expect();
}

Event EventUnpacker::Unpack(PackedReader* from) {
  const Unpacking unpack{terms_, from};
  Event event;
  event.body = EmptyBody(from->Get<std::uint8_t>());
  unpack(event.id);
  unpack(event.time);
  unpack(event.frame);
  unpack(event.simulation);
  unpack(event.causes);
  std::visit(unpack, event.body);
  return event;
}

}  // namespace aerascope
