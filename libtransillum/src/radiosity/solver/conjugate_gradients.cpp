// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "radiosity/solver/conjugate_gradients.h"

#include <Eigen/Core>
#include <Eigen/IterativeLinearSolvers>
#include <limits>

#include "base/power_of_two.h"
#include "transillum/errors.h"

namespace {

/// A matrix given by its product only, for Eigen's matrix-free solvers.
class ProductMatrix;

}  // namespace

namespace Eigen::internal {
template <>
struct traits<ProductMatrix> : traits<SparseMatrix<double>> {};
}  // namespace Eigen::internal

namespace {

class ProductMatrix : public Eigen::EigenBase<ProductMatrix> {
 public:
  using Scalar = double;
  using RealScalar = double;
  using StorageIndex = int;
  // NOLINTBEGIN(readability-identifier-naming): Eigen asks for these names
  enum {
    ColsAtCompileTime = Eigen::Dynamic,
    MaxColsAtCompileTime = Eigen::Dynamic,
    IsRowMajor = 0
  };
  // NOLINTEND(readability-identifier-naming)
  using Function = std::function<void(const double*, double*)>;

  ProductMatrix(const Function& product, Eigen::Index size) : product_(product), size_(size) {}
  Eigen::Index rows() const { return size_; }
  Eigen::Index cols() const { return size_; }
  template <class Right>
  Eigen::Product<ProductMatrix, Right, Eigen::AliasFreeProduct> operator*(
      const Eigen::MatrixBase<Right>& right) const {
    return {*this, right.derived()};
  }
  void apply(const double* x, double* y) const { product_(x, y); }

 private:
  const Function& product_;
  Eigen::Index size_;
};

}  // namespace

namespace Eigen::internal {

template <class Right>
struct generic_product_impl<ProductMatrix, Right, SparseShape, DenseShape, GemvProduct>
    : generic_product_impl_base<ProductMatrix, Right, generic_product_impl<ProductMatrix, Right>> {
  using Scalar = double;
  template <class Destination>
  static void scaleAndAddTo(Destination& destination, const ProductMatrix& matrix,
                            const Right& right, const Scalar& alpha) {
    VectorXd y(right.size());
    matrix.apply(right.data(), y.data());
    destination += alpha * y;
  }
};

}  // namespace Eigen::internal

namespace transillum {

void solve_by_conjugate_gradients(const std::function<void(const double* x, double* y)>& product,
                                  const std::vector<double>& right, double tolerance,
                                  Entries entries, std::vector<double>& x) {
  const auto size = static_cast<Eigen::Index>(right.size());
  bool indefinite = false;
  const std::function<void(const double*, double*)> watched = [&](const double* in, double* out) {
    product(in, out);
    if (entries == Entries::any_sign) {
      const Eigen::Map<const Eigen::VectorXd> v(in, size), image(out, size);
      indefinite = indefinite || v.dot(image) < 0;
    }
  };
  const ProductMatrix matrix(watched, size);
  Eigen::ConjugateGradient<ProductMatrix, Eigen::Lower | Eigen::Upper,
                           Eigen::IdentityPreconditioner>
      solver;
  constexpr double least_tolerance = 16 * std::numeric_limits<double>::epsilon();
  solver.setTolerance(std::max(tolerance, least_tolerance));
  solver.setMaxIterations(1000);
  solver.compute(matrix);
  const Eigen::Map<const Eigen::VectorXd> known(right.data(), size);
  // Scaled, because the squares of very large or very small numbers are out of range.
  const double scale = size > 0 ? scale_to_one(known.cwiseAbs().maxCoeff()) : 1.0;
  const Eigen::VectorXd solution = solver.solve(scale * known) / scale;
  // A matrix I - K, K >= 0, takes some x below 0 to a right side >= 0 exactly where the sum of the
  // powers of K diverges: x is then no limit of the iteration. Values above -`rounding` are
  // not taken as negative.
  constexpr double rounding = 1e-3;
  const bool negative = entries == Entries::at_least_zero && size > 0 &&
                        solution.minCoeff() < -rounding * solution.cwiseAbs().maxCoeff();
  if (solver.info() != Eigen::Success || !solution.allFinite() || negative || indefinite) {
    throw NotConvergent(
        "conjugate gradients do not converge: the row sums of the form factors are too large",
        entries == Entries::any_sign ? Remedy::directions
                                     : Remedy::directions_or_symmetric_normalization);
  }
  x.assign(solution.data(), solution.data() + size);
}

}  // namespace transillum
