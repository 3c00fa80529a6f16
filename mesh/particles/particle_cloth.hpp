// Sewn cloth as particles at the vertices of its triangles: it falls, hangs, bends, and lies on a body. It has
// no lateral contraction, and shows how cloth falls, not pressures.
#pragma once

#include <optional>
#include <vector>

#include "mesh/particles/bending_patch.hpp"
#include "mesh/particles/implicit_particles.hpp"

namespace snug::mesh {

/// Of a fabric.
struct ClothLaws {
  TensileCurve warp, weft;
  double shear = 0.0;                             ///< N/m: energy per area shear phi^2/2, phi (rad) off the right angle
  double bending_warp = 0.0, bending_weft = 0.0;  ///< N m; 0: none at all
  double density = 0.0;                           ///< kg/m2
};

/// An elastic band between two particles: stiffness (N) times strain where it is longer than `length` (m), else slack.
struct ElasticLine {
  int a = 0, b = 0;
  double length = 0.0, stiffness = 0.0;
};

/// A body that bears cloth. Per flat area of it, where it is nearer than `reach` (m): pressing stiffness (N/m3) times
/// how much, along the way off the body at the end of the step before; and friction, which holds it elastically where
/// it touched (half that stiffness) up to the coefficient times what pressed then, and slips beyond.
struct BodyContact {
  std::function<Nearness(const Eigen::Vector3d&)> body;
  double stiffness = 0.0, reach = 0.0, friction = 0.0;
};

/// [Thesis] table 4.3 shows spring (`stretch`), trellis (`shear`), bend and twist (`bending`), and repulse (`pressing`).
enum class ClothForce { stretch, shear, bending, band, pressing, friction, drag, weight };
constexpr auto texts_of(ClothForce) {
  return std::array{"stretch", "shear", "bending", "band", "pressing", "friction", "drag", "weight"};
}

struct ClothSheet {
  std::vector<ClothLaws> laws;
  std::vector<FlatTriangle> triangles;
  std::vector<int> triangle_laws;  ///< index into `laws`; empty: all of the first
  std::vector<ElasticLine> bands;
  double drag = 0.0;         ///< N s/m3: force per flat area against the velocity; 0: no air at all
  double gravity = 9.80665;  ///< m/s2, along -z
  std::optional<BodyContact> body;
};

class ParticleCloth : public ImplicitParticles {
 public:
  /// Places of the particles (m), which begin at rest. Throws std::invalid_argument where numbers do not fit, a
  /// particle has no triangle, or a triangle is turned over on the flat cloth.
  /// `search`: left out, as well as a resting shape needs it, which is judged by itself (`total_forces`).
  ParticleCloth(ClothSheet sheet, Places places, std::vector<HeldComponents> held,
                MinimumSearch search = {.tolerance = 1e-4, .iterations = 6, .take_what_there_is = true});

  /// Kinds of force that the sheet has, in their order; of the others it has none anywhere at any time.
  std::vector<ClothForce> kinds() const;
  /// N, of one kind on every particle.
  Places forces(ClothForce kind) const;
  double area(int particle) const { return area_[particle]; }  ///< m2, flat
  /// Whether a particle is nearer to the body than its reach.
  bool touches(int particle) const { return !planes_.empty() && planes_[particle].pressing > 0.0; }
  /// m, how far the deepest particle is inside the body; 0: none is.
  double penetration() const;

  /// How a triangle is strained: current over flat length along warp and weft, nominal tensions (N/m) there.
  struct Strained {
    Eigen::Vector2d stretch, tension;
    double angle = 0.0;  ///< rad, off the right one
  };
  Strained strained(int triangle) const;

 private:
  /// The body as it is near a particle: a plane, and where friction holds it.
  struct Plane {
    bool near = false, held = false;
    Eigen::Vector3d at, away, anchor;
    double distance = 0.0, pressing = 0.0;  // m of `at`; N
  };
  void add_laws(const Places& x, ForceSum& into) const override;
  void arrive() override;
  bool has(ClothForce kind) const;
  void add(ClothForce kind, const Places& x, ForceSum& into) const;
  void add_strained(bool stretch, bool shear, const Places& x, ForceSum& into) const;
  void add_bending(const Places& x, ForceSum& into) const;
  void add_pressing(const Places& x, ForceSum& into) const;
  void add_friction(const Places& x, ForceSum& into) const;
  void find_planes();
  const ClothLaws& laws_of(std::size_t triangle) const {
    return sheet_.laws[sheet_.triangle_laws.empty() ? 0 : sheet_.triangle_laws[triangle]];
  }

  ClothSheet sheet_;
  struct Directions {  // weights of a triangle's own corners
    std::array<Weight, 3> warp, weft;
    double area = 0.0;
  };
  std::vector<Directions> directions_;   // of the triangles
  Eigen::SparseMatrix<double> bending_;  // N/m: its energy is x^T K x/2 for each component of the places
  std::vector<double> area_;
  std::vector<Plane> planes_;  // of the particles; none without a body
};

}  // namespace snug::mesh
