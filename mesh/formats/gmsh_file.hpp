// A gmsh mesh or script of somebody else as plain data. gmsh reads it in a process of its own.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "mesh/formats/contained.hpp"

namespace snug::mesh {

struct GmshElements {
  int type = 0, dimension = 0, entity = 0;  ///< type: gmsh's number (its reference manual, "MSH file format")
  std::vector<std::uint64_t> tags, nodes;   ///< node tags, as many an element as the type has
};

struct GmshGroup {
  std::string name;  ///< its number where it has none, of curves and points with the word before it
  int dimension = 0, tag = 0;
  std::vector<int> entities;
  std::vector<std::uint64_t> nodes;
};

struct GmshType {
  int type = 0, nodes = 0;
  std::string name;
  std::vector<double> local;  ///< reference coordinates, three a node
};

struct GmshMesh {
  std::vector<std::uint64_t> node_tags;
  std::vector<double> x;  ///< three a node, in the file's unit
  std::vector<GmshElements> elements;
  std::vector<GmshGroup> groups;
  std::vector<GmshType> types;  ///< of the elements

  std::vector<int> types_of(int dimension) const;
  const GmshType& type(int number) const;
};

/// What is done after reading: `quadratic` makes straight volume cells of one kind quadratic, `linear` the other way round.
enum class GmshOrder { as_it_is, quadratic, linear };

struct GmshOptions {
  GmshOrder order = GmshOrder::as_it_is;
  bool allow_scripts = false;  ///< a script may do what gmsh lets it do, with the option file beside it
  Limits limits = {};
};

/// Reads a file. What it begins with tells a mesh ($MeshFormat); only a file named .geo is a script, and
/// is checked (checked_script) and meshed. Option files beside it are not read. Throws input::InputError: no gmsh file, what
/// gmsh says with file and line, crash, time or memory used up.
GmshMesh read_gmsh_file(const std::filesystem::path& path, const GmshOptions& options);

}  // namespace snug::mesh
