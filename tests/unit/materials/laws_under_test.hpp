// Every law with parameters of its own, for the typed tests; gradients they are asked at.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "materials/laws/solid_law.hpp"
#include "materials/laws/tensor.hpp"

namespace snug::testing {

/// Pa; the modulus and compressibility of the reference book's states, so that the laws differ by their form alone.
template <class Law>
Law example();

inline const materials::Volumetric example_volume{materials::VolumetricForm::barrier, 1490e3 / 3.0};

template <>
inline materials::NeoHooke example() {
  return {.shear_modulus = 10e3, .volume = example_volume};
}
template <>
inline materials::MooneyRivlin example() {
  return {.C10 = 4e3, .C01 = 1e3, .volume = example_volume};
}
template <>
inline materials::Ogden example() {
  return {.terms = {{6e3, 1.3}, {0.3e3, 5.0}, {-5.35e3, -2.0}}, .volume = example_volume};
}
template <>
inline materials::Yeoh example() {
  return {.C10 = 5e3, .C20 = -0.8e3, .C30 = 0.3e3, .volume = example_volume};
}
template <>
inline materials::ArrudaBoyce example() {
  const double m2 = 1.6 * 1.6;  // of the shear modulus, by the manuals of the programs that have the law
  const double stiffer = 1.0 + 3.0 / (5.0 * m2) + 99.0 / (175.0 * m2 * m2) + 513.0 / (875.0 * std::pow(m2, 3)) + 42039.0 / (67375.0 * std::pow(m2, 4));
  return {.mu = 10e3 / stiffer, .locking_stretch = 1.6, .volume = example_volume};
}
template <>
inline materials::Fung example() {
  return {.shear_modulus = 10e3, .stiffening = 0.7, .volume = example_volume};
}
template <>
inline materials::CompressibleNeoHooke example() {
  return {.shear_modulus = 10e3, .lame_parameter = 1470e3 / 3.0};
}
template <>
inline materials::LinearElastic example() {
  return {.youngs_modulus = 29.8e3, .poisson_ratio = 0.49};
}

using SplitLaws = ::testing::Types<materials::NeoHooke, materials::MooneyRivlin, materials::Ogden, materials::Yeoh, materials::ArrudaBoyce, materials::Fung>;
using AllLaws = ::testing::Types<materials::NeoHooke, materials::MooneyRivlin, materials::Ogden, materials::Yeoh, materials::ArrudaBoyce, materials::Fung,
                                 materials::CompressibleNeoHooke, materials::LinearElastic>;

/// General F of the reference book 1.1.
inline Eigen::Matrix3d reference_gradient() {
  Eigen::Matrix3d F;
  F << 1.1, 0.2, 0.0, 0.05, 0.95, 0.1, 0.0, 0.1, 1.05;
  return F;
}
inline Eigen::Matrix3d large_gradient() {
  Eigen::Matrix3d F;
  F << 1.8, -0.4, 0.3, 0.6, 0.7, 0.2, -0.3, 0.5, 1.4;
  return F;
}
/// F with two equal and with three equal principal stretches, turned; Ogden's tangent has its special case there.
inline Eigen::Matrix3d equal_stretches(double first) {
  const Eigen::Matrix3d Q = Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, 2, -0.5).normalized()).toRotationMatrix();
  const Eigen::Matrix3d R = Eigen::AngleAxisd(-0.4, Eigen::Vector3d(0, 1, 1).normalized()).toRotationMatrix();
  return R * Q * Eigen::Vector3d(first, 1.2, 1.2).asDiagonal() * Q.transpose();
}

inline Eigen::Matrix3d cauchy(const materials::SolidLaw& law, const Eigen::Matrix3d& F) {
  return materials::coupled(law, F).stress * F.transpose() / F.determinant();
}

inline Eigen::VectorXd packed(const Eigen::Matrix3d& F) { return materials::components(F); }
inline Eigen::Matrix3d unpacked(const Eigen::VectorXd& x) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(x.data());
}

}  // namespace snug::testing
