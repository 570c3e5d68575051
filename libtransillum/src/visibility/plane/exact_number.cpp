// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/plane/exact_number.h"

#include <gmp.h>

#include <cstdlib>
#include <new>

namespace transillum {
namespace {

/// GMP's functions in C can be left by an exception; they leak at most what they had allocated.
void* allocate(std::size_t size) {
  void* place = std::malloc(size);
  if (place == nullptr) {
    throw std::bad_alloc();
  }
  return place;
}

void* reallocate(void* old, std::size_t, std::size_t size) {
  void* place = std::realloc(old, size);
  if (place == nullptr) {
    throw std::bad_alloc();
  }
  return place;
}

CGAL::Gmpz in_units(CGAL::Gmpz number) {
  constexpr unsigned long unit_bits = 1200;
  number <<= unit_bits;
  return number;
}

}  // namespace

void let_exact_numbers_throw() {
  static const bool done = [] {
    // GMP frees by std::free(), as before, so numbers made earlier remain valid.
    mp_set_memory_functions(allocate, reallocate, nullptr);
    return true;
  }();
  (void)done;
}

ExactArea::ExactArea(const Rational& area)
    : units_(in_units(area.numerator()) / area.denominator()) {}

double nearest_double(const ExactArea& area) {
  const Rational exact(area.units_, in_units(1));
  // The interval holds one or two doubles.
  const auto [low, high] = CGAL::to_interval(exact);
  return exact - Rational(low) <= Rational(high) - exact ? low : high;
}

}  // namespace transillum
