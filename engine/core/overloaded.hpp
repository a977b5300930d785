#pragma once
// Several lambdas as one function object for std::visit. An alternative without a lambda is an error of the compiler.

namespace rill {

template <class... Calls>
struct Overloaded : Calls... {
  using Calls::operator()...;
};
template <class... Calls>
Overloaded(Calls...) -> Overloaded<Calls...>;

}  // namespace rill
