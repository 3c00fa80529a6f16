// Supports, forces and pressures of a FEBio file.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "mesh/formats/febio_document.hpp"
#include "mesh/formats/model.hpp"

namespace snug::mesh {

/// Corners of a facet, in the order that its normal turns about, and where it stands.
struct FebioFacet {
  std::vector<int> nodes;
  pugi::xml_node xml;
};
using FebioSurfaces = std::map<std::string, std::vector<FebioFacet>>;

class FebioLoads {
 public:
  /// Into a model whose elements and sets are there; `time`: of the load curves.
  FebioLoads(const FebioDocument& document, const FebioSurfaces& surfaces, Model& model, double time) : document_(document), surfaces_(surfaces), model_(model), time_(time) {}

  /// <Boundary> and <Loads> of the file or of a step; reports what is not taken over.
  void read(const pugi::xml_node& parent);

 private:
  void hold(const pugi::xml_node& bc);
  void move(const pugi::xml_node& bc);
  void push(const pugi::xml_node& load);
  void press(const pugi::xml_node& load);
  const std::vector<int>& nodes_of(const pugi::xml_node& node) const;
  int component(const pugi::xml_node& node, std::string_view name) const;
  void index_faces();

  const FebioDocument& document_;
  const FebioSurfaces& surfaces_;
  Model& model_;
  double time_;
  struct Face {
    int element, face;
    std::vector<int> corners;  ///< as the element has them: the normal points inwards
  };
  std::map<std::vector<int>, Face> faces_;  ///< by sorted corners
};

}  // namespace snug::mesh
