// Several lambdas as one visitor: std::visit(Overloaded{...}, variant).
#pragma once

namespace aerascope {

template <class... Handlers>
struct Overloaded : Handlers... {
  using Handlers::operator()...;
};
template <class... Handlers>
Overloaded(Handlers...) -> Overloaded<Handlers...>;

}  // namespace aerascope
