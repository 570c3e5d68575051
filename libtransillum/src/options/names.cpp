// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Names of normalizations, bases and schemes.
#include "base/choice.h"
#include "transillum/at.h"
#include "transillum/radiosity.h"

namespace transillum {

const std::vector<std::string>& normalization_names() {
  static const std::vector<std::string> names{"none", "rows", "symmetric"};
  return names;
}

Normalization normalization_from_name(const std::string& name) {
  return choice_from_name<Normalization>(normalization_names(), "normalization", name);
}

const std::string& name_of(Normalization normalization) {
  return at(normalization_names(), normalization);
}

const std::vector<std::string>& basis_names() {
  static const std::vector<std::string> names{"constant", "linear"};
  return names;
}

Basis basis_from_name(const std::string& name) {
  return choice_from_name<Basis>(basis_names(), "basis", name);
}

const std::string& name_of(Basis basis) { return at(basis_names(), basis); }

const std::vector<std::string>& scheme_names() {
  static const std::vector<std::string> names{"fixed", "growing", "semi-iterative",
                                              "conjugate-gradients"};
  return names;
}

Scheme scheme_from_name(const std::string& name) {
  return choice_from_name<Scheme>(scheme_names(), "scheme", name);
}

const std::string& name_of(Scheme scheme) { return at(scheme_names(), scheme); }

}  // namespace transillum
