// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Tables of normalizations, bases and schemes.
#include <array>

#include "base/choice.h"
#include "transillum/at.h"
#include "transillum/solve_options.h"

namespace transillum {
namespace {

constexpr std::array normalizations{
    Choice{Normalization::none, "none", "None (paper)", "the paper's estimator"},
    Choice{Normalization::rows, "rows", nullptr,
           "divide each row of form factors by the quadrature of its cosine"},
    Choice{Normalization::symmetric, "symmetric", nullptr,
           "scale rows and columns alike so that rows sum to 1"},
};

constexpr std::array bases{
    Choice{Basis::constant, "constant", nullptr, "one value of B per patch"},
    Choice{Basis::linear, "linear", nullptr,
           "a linear function on each patch, from engines fast, local, exact and pairs"},
};

constexpr std::array schemes{
    SchemeTraits{.value = Scheme::fixed,
                 .name = "fixed",
                 .label = "Fixed",
                 .sentence = "the same directions in every iteration"},
    SchemeTraits{.value = Scheme::growing,
                 .name = "growing",
                 .label = "Growing",
                 .sentence = "twice as many in each iteration, up to M"},
    SchemeTraits{.value = Scheme::semi_iterative,
                 .name = "semi-iterative",
                 .label = "Semi-iterative",
                 .sentence = "new directions in each iteration, and the mean over iterations",
                 .renews_directions = true},
    SchemeTraits{.value = Scheme::conjugate_gradients,
                 .name = "conjugate-gradients",
                 .label = "Conjugate gradients",
                 .sentence = "as fixed, solved in symmetric form",
                 .is_symmetric = true},
};

}  // namespace

template <>
const Choices& choices_of<Normalization>() {
  return texts_of<normalizations>("normalization");
}

template <>
const Choices& choices_of<Basis>() {
  return texts_of<bases>("basis");
}

template <>
const Choices& choices_of<Scheme>() {
  return texts_of<schemes>("scheme");
}

const SchemeTraits& traits_of(Scheme scheme) { return at(schemes, scheme); }

}  // namespace transillum
