// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The inner loops of lobes compute four directions at a time, with the instructions that the
// processor has: they must give the bits of the plain formulas.
#include "radiosity/glossy/lobe_vectors.h"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

#include "radiosity/glossy/lobe_kernel.h"
#include "transillum/directions.h"

namespace transillum::lobe_vectors_test {
namespace {

Hemisphere hemisphere(int directions) {
  std::vector<Vec3> set;
  for (const DirectionSample& sample : make_directions(Sampling::antipodal, directions, 1)) {
    set.push_back(sample.direction);
  }
  return {set, normalized(Vec3{0.1, -0.3, 0.8})};
}

TEST(LobeVectors, RowsHaveTheBitsOfSingleValues) {
  std::vector<Lobe> lobes;
  for (const double exponent : {0.0, 1.0, 2.0, 7.0, 24.0, 1000.0, 2.5}) {
    lobes.emplace_back().exponent = exponent;
  }
  for (const double roughness : {0.01, 0.3, 1.0}) {
    Lobe& lobe = lobes.emplace_back();
    lobe.shape = LobeShape::ggx;
    lobe.roughness = roughness;
  }
  for (const int directions : {1, 3, 4, 37, 128}) {
    const Hemisphere above = hemisphere(directions);
    for (const Lobe& lobe : lobes) {
      const LobeKernel kernel(lobe);
      std::vector<double> values(above.size());
      for (std::size_t p = 0; p < above.size(); ++p) {
        const Vec3 a = above.direction(p);
        kernel.row(a, above.cosine[p], above, values.data());
        for (std::size_t q = 0; q < above.size(); ++q) {
          const double between = a.x * above.x[q] + a.y * above.y[q] + a.z * above.z[q];
          ASSERT_EQ(values[q], kernel.value(above.cosine[p], above.cosine[q], between))
              << lobe.exponent << " " << lobe.roughness << ", M = " << directions << ": " << p
              << " " << q;
        }
      }
    }
  }
}

/// There are four partial sums, each of every fourth product; the remaining products are added to
/// the first.
double product(const double* a, const double* b, std::size_t count) {
  std::array<double, 4> sums{};
  const std::size_t whole = count - count % 4;
  for (std::size_t q = 0; q < count; ++q) {
    sums[q < whole ? q % 4 : 0] += a[q] * b[q];
  }
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

TEST(LobeVectors, ProductsHaveTheBitsOfFourPartialSums) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  for (const std::size_t count : {1U, 4U, 7U, 64U, 101U}) {
    for (const std::size_t row_count : {1U, 2U, 4U, 7U, 33U}) {
      for (const std::size_t planes : {1U, 3U}) {
        std::vector<double> rows(row_count * count), vectors(planes * count);
        for (std::vector<double>* values : {&rows, &vectors}) {
          for (double& v : *values) {
            v = number(random);
          }
        }
        std::vector<double> result(row_count * planes);
        multiply_rows(rows.data(), row_count, vectors.data(), planes, count, result.data());
        for (std::size_t r = 0; r < row_count; ++r) {
          for (std::size_t k = 0; k < planes; ++k) {
            ASSERT_EQ(result[r * planes + k],
                      product(rows.data() + r * count, vectors.data() + k * count, count))
                << count << " " << row_count << " " << planes << ": " << r << " " << k;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace transillum::lobe_vectors_test
