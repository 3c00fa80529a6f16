#include "mesh/formats/gmsh_session.hpp"

#include <gmsh.h>

namespace snug::mesh {

GmshSession::GmshSession() {
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::option::setNumber("General.NumThreads", 1);
  gmsh::option::setNumber("Mesh.SecondOrderIncomplete", 0);  // complete 27-node hexahedra
}

GmshSession::~GmshSession() { gmsh::finalize(); }

}  // namespace snug::mesh
