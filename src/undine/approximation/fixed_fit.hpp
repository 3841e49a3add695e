#pragma once
#include <Eigen/SVD>
#include <limits>

#include "undine/approximation/polynomials.hpp"

namespace undine::approximation {

/// Least squares by singular values: row k of the solution holds the weights of the data in coefficient k.
///   minimise sum_j w_j^2 (u_j - sum_k P_jk c_k)^2:  c = (wP)^+ w u
struct FixedFit {
  Eigen::MatrixXd coefficients;  ///< terms x points
  double condition;              ///< of w P

  /// P: points x terms; w: one root of a weight for each point.
  FixedFit(const Eigen::MatrixXd& P, const Eigen::VectorXd& w) {
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(w.asDiagonal() * P, Eigen::ComputeThinU | Eigen::ComputeThinV);
    const Eigen::VectorXd& sigma = svd.singularValues();
    const double least = sigma[sigma.size() - 1];
    condition = least > 0 ? sigma[0] / least : std::numeric_limits<double>::infinity();
    coefficients = svd.matrixV() * sigma.cwiseInverse().asDiagonal() * svd.matrixU().transpose() * w.asDiagonal();
  }
};

/// The condition number of a small matrix, in the Euclidean norm.
inline double condition_number(const Eigen::MatrixXd& A) {
  const Eigen::VectorXd sigma = Eigen::JacobiSVD<Eigen::MatrixXd>(A).singularValues();
  const double least = sigma[sigma.size() - 1];
  return least > 0 ? sigma[0] / least : std::numeric_limits<double>::infinity();
}

}  // namespace undine::approximation
