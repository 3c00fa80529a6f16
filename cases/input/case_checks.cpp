#include "cases/input/case_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "cases/input/garment_checks.hpp"
#include "cases/input/posture_checks.hpp"
#include "cases/input/suggestion.hpp"
#include "cases/input/units.hpp"

namespace snug::input {

namespace {

void check_shells(const BodySpec& body, Diagnostics& diagnostics) {
  for (const LayerSpec& layer : body.layers) {
    if (layer.form == LayerForm::shell && body.kind != BodyKind::imported)
      diagnostics.error(layer.where, fmt::format("layer \"{}\" is a shell", layer.name),
                        "shells are surfaces of an imported mesh: kind = \"imported\"");
    if (layer.form == LayerForm::shell && !layer.thickness && body.mesh.extension() == ".msh")
      diagnostics.error(layer.where, fmt::format("the shell \"{}\" has no thickness", layer.name),
                        "give it, e.g. thickness = \"2 mm\"");
    if (layer.form != LayerForm::shell && layer.foundation != 0.0)
      diagnostics.error(layer.where, fmt::format("layer \"{}\" has a foundation and is no shell", layer.name),
                        "write form = \"shell\" or leave foundation out");
  }
}

void check_layer_order(const std::vector<LayerSpec>& layers, Diagnostics& diagnostics) {
  if (layers.front().form == LayerForm::solid && layers.front().thickness)
    diagnostics.error(layers.front().where, fmt::format("the innermost layer \"{}\" has a thickness", layers.front().name),
                      "begin with the bone, rigid or elastic, and leave its thickness out: its outline comes from the "
                      "stations or the scan");
  for (std::size_t n = 1; n < layers.size(); ++n) {
    if (layers[n].form == LayerForm::rigid)
      diagnostics.error(layers[n].where, fmt::format("the rigid layer \"{}\" is not the innermost", layers[n].name),
                        "list the bone first; only it can be rigid");
    if (layers[n].form == LayerForm::membrane && n + 1 != layers.size())
      diagnostics.error(layers[n].where, fmt::format("the membrane \"{}\" is not the outermost layer", layers[n].name),
                        "list the skin last, or give this layer form = \"solid\"");
  }
}

void check_thicknesses(const BodySpec& body, Diagnostics& diagnostics) {
  std::vector<std::string> open;
  int solids = 0;
  for (const LayerSpec& layer : body.layers) {
    if (layer.form == LayerForm::membrane && !layer.thickness)
      diagnostics.error(layer.where, fmt::format("the membrane \"{}\" has no thickness", layer.name),
                        "give it, e.g. thickness = \"1.5 mm\"");
    if (layer.form == LayerForm::rigid && layer.thickness)
      diagnostics.error(layer.where, fmt::format("the rigid layer \"{}\" has a thickness", layer.name),
                        "leave it out: the outline of the bone comes from the stations or the scan");
    if (layer.form != LayerForm::solid || &layer == &body.layers.front()) continue;  // an elastic bone has its outline
    ++solids;
    if (!layer.thickness) open.push_back(layer.name);
  }
  if (solids == 0)
    diagnostics.error(body.where, "the body has no solid layer between bone and skin",
                      "add one, e.g. { name = \"tissue\", material = \"relaxed thigh\" }");
  else if (open.size() != 1)
    diagnostics.error(body.where, fmt::format("{} solid layers have no thickness", open.size()),
                      "leave the thickness out at exactly one solid layer: it takes the rest between bone and skin");
}

void check_names(const BodySpec& body, Diagnostics& diagnostics) {
  std::set<std::string> seen;
  for (const LayerSpec& layer : body.layers)
    if (!seen.insert(layer.name).second && !layer.name.empty())
      diagnostics.error(layer.where, fmt::format("a second layer is called \"{}\"", layer.name),
                        "give each layer its own name");
  seen.clear();
  for (const LocationSpec& location : body.locations)
    if (!seen.insert(location.name).second && !location.name.empty())
      diagnostics.error(location.where, fmt::format("a second location is called \"{}\"", location.name),
                        "give each location its own name");
}

/// Of the three kinds of patch exactly one is given, and whole.
void check_patch(const LocationSpec& location, Diagnostics& diagnostics) {
  const bool angles = !std::isnan(location.from_angle) || !std::isnan(location.to_angle);
  const int kinds = (angles || location.limb ? 1 : 0) + (location.at ? 1 : 0) + (location.polygon.empty() ? 0 : 1);
  const auto refuse = [&](const std::string& found, const std::string& remedy) { diagnostics.error(location.where, fmt::format("\"{}\" {}", location.name, found), remedy); };
  if (kinds != 1)
    return refuse(kinds == 0 ? "has no patch" : "has patches of several kinds", "give one: from_angle and to_angle, or at and radius, or polygon");
  if (location.is_sector() && (std::isnan(location.from_angle) || std::isnan(location.to_angle))) refuse("has half a sector", "add from_angle and to_angle");
  if (location.at && !location.radius) refuse("has a landmark and no radius", "add radius = \"30 mm\"");
  if (!location.at && location.radius) refuse("has a radius and no landmark", "add at = [x, y, z], a point of the skin");
  if (!location.polygon.empty() && location.polygon.size() < 3) refuse("has a polygon of fewer than three landmarks", "add landmarks along its border");
}

void check_locations(const BodySpec& body, Diagnostics& diagnostics) {
  for (const LocationSpec& location : body.locations) {
    check_patch(location, diagnostics);
    const double sector = location.to_angle - location.from_angle;
    if (!std::isnan(sector) && !(sector > 0.0 && sector <= 2.0 * std::numbers::pi + 1e-12))
      diagnostics.error(
          location.where,
          fmt::format("the sector of \"{}\" is {:.4g} deg wide", location.name, sector * 180.0 / std::numbers::pi),
          "let to_angle lie above from_angle by at most 360 deg, e.g. from \"-45 deg\" to \"45 deg\"");
    if (location.from_height && location.to_height && !(*location.to_height > *location.from_height))
      diagnostics.error(location.where, fmt::format("to_height of \"{}\" is not above from_height", location.name),
                        "heights count upwards from the lower cut's side");
  }
}

void check_kind(const BodySpec& body, const Table& table, Diagnostics& diagnostics) {
  struct Kind {
    BodyKind kind;
    std::string key, what, remedy;
  };
  const std::vector<Kind> kinds = {
      {BodyKind::stations, "stations", "stations", "name the CSV file of the girths: stations = \"body/limb.csv\""},
      {BodyKind::scan, "scan", "a section [body.scan]", "add [body.scan] with surface, and lower, upper and bone or [[body.scan.cut]] and core"},
      {BodyKind::imported, "mesh", "a mesh", "name its file (.msh, .cdb, .inp): mesh = \"body/limb.msh\""}};
  for (const Kind& kind : kinds) {
    if (kind.kind == body.kind && !table.find(kind.key))
      diagnostics.error(body.where, fmt::format("kind = \"{}\" needs {}", text_of(body.kind), kind.what), kind.remedy);
    if (kind.kind != body.kind && table.find(kind.key))
      diagnostics.error(table.where_is(kind.key),
                        fmt::format("{} is given, but kind = \"{}\" does not use it", kind.key, text_of(body.kind)),
                        fmt::format("leave it out or write kind = \"{}\"", text_of(kind.kind)));
  }
}

/// The layers of an imported mesh are named in any order; sizes come from the mesh.
void check_imported(const BodySpec& body, const Table& table, Diagnostics& diagnostics) {
  for (const LayerSpec& layer : body.layers)
    if (layer.form == LayerForm::solid && layer.thickness)
      diagnostics.error(layer.where, fmt::format("layer \"{}\" of an imported mesh has a thickness", layer.name),
                        "leave it out: the mesh says where the layer is");
  const std::string ending = body.mesh.extension().string();
  if (ending == ".msh" && table.find("force_unit"))
    diagnostics.error(table.where_is("force_unit"), "force_unit does not apply to a gmsh file", "leave it out: the file has no forces");
  if ((ending == ".msh" || ending == ".geo") && table.find("load_step"))
    diagnostics.error(table.where_is("load_step"), "load_step does not apply to a gmsh file", "leave it out: the file has no load steps");
  for (const char* key : {"cells_around", "cells_along", "ends"})
    if (table.find(key))
      diagnostics.error(table.where_is(key), fmt::format("{} does not apply to an imported mesh", key),
                        "leave it out; hold surfaces of the mesh with [[support]]");
}

/// Cuts by the names lower and upper belong to one limb of hexahedra or tetrahedra, those of the list to anything.
void check_scan(const ScanSpec& scan, const Table& table, Diagnostics& diagnostics) {
  const Location where = table.where;
  const bool lower = table.find("lower"), upper = table.find("upper"), standard = table.find("standard");
  if (!standard && !table.find("surface"))
    diagnostics.error(where, "the scan has neither a surface nor a standard body", "name its file: surface = \"body/scan.obj\", or standard = \"woman\"");
  if (scan.cuts.empty() && !(lower && upper) && !(standard && !lower && !upper))  // without any, the standard body has its own say
    diagnostics.error(where, "the scan has no cuts", "add lower and upper for one limb, or [[body.scan.cut]] with name, point and normal");
  if (!scan.cuts.empty() && (lower || upper))
    diagnostics.error(table.where_is(lower ? "lower" : "upper"), "the scan has named cuts and lower or upper", "name all of them: [[body.scan.cut]]");
  std::set<std::string> seen = {"skin", "bone"};
  for (const NamedCut& cut : scan.cuts) {
    if (!cut.name.empty() && !seen.insert(cut.name).second)
      diagnostics.error(cut.where, fmt::format("the name \"{}\" of a cut is taken", cut.name), "give each cut its own name; skin and bone are surfaces of the body");
    if (!standard && (std::isnan(cut.point[0]) || std::isnan(cut.normal[0])))
      diagnostics.error(cut.where, fmt::format("the cut \"{}\" has no {}", cut.name, std::isnan(cut.point[0]) ? "point" : "normal"),
                        "give it: point = [x, y, z] in the limb and normal = [0, 0, 1] out of what is kept; names alone serve on a body that ships: standard = \"woman\"");
    if (cut.normal == std::array<double, 3>{0, 0, 0})
      diagnostics.error(cut.where, fmt::format("the normal of \"{}\" has no length", cut.name), "write the direction out of the piece that is kept");
  }
  if (!scan.bone && !scan.core)
    diagnostics.error(where, "the scan has neither bone nor core", "add bone = { girth = \"90 mm\" } for a limb, or core = { thickness = \"30 mm\" }");
  if (scan.cells == ScanCells::hexahedra && !scan.bone)
    diagnostics.error(where, "hexahedra need the outline of a bone", "add bone = { girth = \"90 mm\" }, or write cells = \"tetrahedra\"");
  if (scan.core && scan.core->surface.empty() == !scan.core->thickness)
    diagnostics.error(table.where_is("core"), "the core has a surface and a thickness, or neither", "give one of the two");
}

void check_body(const BodySpec& body, const Table& table, Diagnostics& diagnostics) {
  check_kind(body, table, diagnostics);
  check_names(body, diagnostics);
  check_shells(body, diagnostics);
  check_locations(body, diagnostics);
  const bool own_layers = body.kind == BodyKind::imported && !table.find("layers");  // the file has them, or its reader says so
  if (own_layers) return check_imported(body, table, diagnostics);
  if (body.layers.empty())
    return diagnostics.error(table.find("layers") ? table.where_is("layers") : body.where, "the body has no layers",
                             "list them from the inside out, the bone first");
  if (body.kind == BodyKind::imported) return check_imported(body, table, diagnostics);
  const Table* scan = table.table("scan");
  if (body.kind == BodyKind::scan && body.scan && scan) check_scan(*body.scan, *scan, diagnostics);
  check_layer_order(body.layers, diagnostics);
  check_thicknesses(body, diagnostics);
}

/// A surface of the body; that it is there is known when the mesh is.
bool between_solids(const ContactSpec& contact, const Case& c) {
  return !contact.slave.empty() && std::none_of(c.garments.begin(), c.garments.end(),
                                                [&](const GarmentSpec& garment) { return garment.name == contact.slave; });
}

void check_presence(const Case& c, const Table& root, Diagnostics& diagnostics) {
  const auto error = [&](const std::string& key, const std::string& found, const std::string& remedy) {
    diagnostics.error(root.where_is(key), found, remedy);
  };
  const bool body = root.find("body"), garment = root.find("garment");
  const bool load = root.find("load"), support = root.find("support"), tool = root.find("tool"), posture = root.find("posture");
  const bool solids = std::any_of(c.contacts.begin(), c.contacts.end(), [&](const auto& contact) { return between_solids(contact, c); });
  if (!body && !garment)
    error("", "the case names neither a body nor a garment", "add [body], and [garment] with [contact]");
  if (garment && !body)
    error("garment", "there is a [garment] but no [body]",
          "add [body]; for a rigid one write tier = \"L1\" in [solver]. A garment alone is not available yet");
  if (garment && body && !root.find("contact"))
    error("garment", "there is a [garment] on a [body] but no [contact]: they would not touch", "add a line [contact]");
  if (root.find("contact") && !garment && !solids)
    error("contact", "there is [contact] but no [garment]",
          "add [garment], name two surfaces of the body (slave, master), or leave [contact] out");
  if (root.find("comfort") && !(root.find("contact") && garment))
    error("comfort", "[comfort] judges contact pressure, but there is no [contact]",
          "add [garment] and [contact], or leave [comfort] out");
  if (load && !body) error("load", "there is a [load] but no [body]", "add [body] or leave [load] out");
  if (support && !body) error("support", "there is a [[support]] but no [body]", "add [body] or leave it out");
  if (tool && !body) error("tool", "there is a [[tool]] but no [body]", "add [body] or leave it out");
  const Table* imported = root.table("body");  // a file of another program may bring its loads; without, that is said later
  if (body && !garment && !load && !support && !tool && !posture && !(imported && imported->find("mesh")))
    error("body", "nothing acts on the body", "add [garment] with [contact], [load], a [[support]] that moves, a [[tool]] or a [[posture]]");
}

/// A garment lies on the skin or on one that is listed before it, whose triangles are quadratic.
void check_master(const ContactSpec& contact, const Case& c, Diagnostics& diagnostics) {
  if (contact.master.empty() || contact.master == "skin") return;
  const auto place = [&](const std::string& name) {
    return std::find_if(c.garments.begin(), c.garments.end(), [&](const GarmentSpec& garment) { return garment.name == name; });
  };
  const auto inner = place(contact.master);
  if (inner == c.garments.end())
    diagnostics.error(contact.where, fmt::format("a garment is to lie on \"{}\", which is no garment of the case", contact.master),
                      "name the garment under it, or leave master out: it meets what it lies over");
  else if (contact.slave.empty())
    diagnostics.error(contact.where, fmt::format("every garment is to lie on \"{}\"", contact.master), "say which one does: slave = \"band\"");
  else if (inner >= place(contact.slave))
    diagnostics.error(contact.where, fmt::format("\"{}\" is to lie on \"{}\", which is listed {}", contact.slave, contact.master,
                                                 contact.slave == contact.master ? "as itself" : "after it"),
                      "list garments from the skin outwards");
}

void check_contacts(const Case& c, Diagnostics& diagnostics) {
  std::set<std::string> named;
  int open = 0;
  for (const ContactSpec& contact : c.contacts) {
    const bool solids = between_solids(contact, c);
    if (contact.slave.empty() && ++open > 1)
      diagnostics.error(contact.where, "two contacts name no slave", "say which garment each is of: slave = \"band\"");
    if (!contact.slave.empty() && !named.insert(contact.slave).second)
      diagnostics.error(contact.where, fmt::format("\"{}\" is the slave of two contacts", contact.slave), "name it once");
    if (!solids) check_master(contact, c, diagnostics);
    if (solids && contact.slave == contact.master)
      diagnostics.error(contact.where, fmt::format("\"{}\" is to touch itself", contact.slave), "name two surfaces");
    if (solids && c.solver.tier != Tier::L4)
      diagnostics.error(contact.where, fmt::format("tier {} has a rigid body, whose surfaces do not move", text_of(c.solver.tier)),
                        "use tier L4 or leave this [[contact]] out");
  }
  for (const GarmentSpec& garment : c.garments)
    if (open == 0 && !c.contacts.empty() && !named.contains(garment.name))
      diagnostics.error(garment.where, fmt::format("no [[contact]] is of the garment \"{}\"", garment.name),
                        fmt::format("add one with slave = \"{}\", or one without slave for all garments", garment.name));
}

void check_loads(const Case& c, const Table& root, Diagnostics& diagnostics) {
  if (!c.load) return;
  if (const Table* load = root.table("load"); load && load->keys().empty())
    diagnostics.error(root.where_is("load"), "the section [load] has no load",
                      "add one, e.g. skin_pressure = \"5 kPa\", or leave [load] out");
  for (const Force& force : c.load->force)
    if (force.at.has_value() == !force.on.empty())
      diagnostics.error(force.where, force.at ? "a force has both at and on" : "a force has neither at nor on",
                        "write at = [x, y, z] for a point, or on = \"name\" for a surface");
}

void check_supports(const Case& c, Diagnostics& diagnostics) {
  for (const SupportSpec& support : c.support) {
    if (!support.x && !support.y && !support.z)
      diagnostics.error(support.where, fmt::format("the support of \"{}\" holds nothing", support.on),
                        "give a displacement, e.g. x = \"0 mm\"");
    if (support.turn != 0.0 && (!support.x || !support.y))
      diagnostics.error(support.where, fmt::format("\"{}\" is turned but x or y is free", support.on),
                        "add x = \"0 mm\" and y = \"0 mm\"");
  }
}

void check_tools(const Case& c, Diagnostics& diagnostics) {
  std::set<std::string> names = {"body", "garment", "contact", "bone", ""};  // of other parts of a scene
  for (const SupportSpec& support : c.support) names.insert(support.on);
  for (const GarmentSpec& garment : c.garments) names.insert(garment.name);
  for (const ToolSpec& tool : c.tools) {
    if (!names.insert(tool.name).second)
      diagnostics.error(tool.where, fmt::format("a tool is called \"{}\", as something else is", tool.name), "give each tool a name of its own, e.g. name = \"probe\"");
    if (tool.direction == std::array<double, 3>{0, 0, 0})
      diagnostics.error(tool.where, fmt::format("the direction of \"{}\" is zero", tool.name), "say where it goes and faces, e.g. direction = [-1, 0, 0]");
    if (tool.shape == ToolShape::disc && tool.edge_radius > tool.radius)
      diagnostics.error(tool.where, fmt::format("the edge of \"{}\" is rounded by {:.4g} mm and the disc has a radius of {:.4g} mm", tool.name, 1e3 * tool.edge_radius, 1e3 * tool.radius),
                        "let edge_radius be at most the radius (a ball: shape = \"sphere\")");
    if (!c.garments.empty())
      diagnostics.error(tool.where, fmt::format("\"{}\" meets the body, and the case has a garment on it", tool.name),
                        "leave the garment or the tool out: a tool on a garment is not available");
    if (c.solver.tier != Tier::L4)
      diagnostics.error(tool.where, fmt::format("tier {} has a rigid body, into which \"{}\" cannot go", text_of(c.solver.tier), tool.name), "use tier L4 or leave the tool out");
    if (c.solver.path == LoadPath::arc_length)
      diagnostics.error(tool.where, "a tool that is moved needs no path = \"arc length\": its force may fall as it goes", "leave path out");
  }
}

void check_reference(const Case& description, const Table& root, Diagnostics& diagnostics) {
  if (!description.reference) return;
  const Location where = root.where_is("reference");
  if (!description.reference->displacement && !description.reference->stress)
    diagnostics.error(where, "[reference] names nothing to compare",
                      "add displacement = { file = \"reference/displacement.lis\", relative = 1e-3 }, or stress");
  if (!description.body) diagnostics.error(where, "there is a [reference] but no [body]", "leave [reference] out");
}

void check_path(const Case& c, const Table& root, Diagnostics& diagnostics) {
  if (c.solver.path != LoadPath::arc_length) return;
  const Location where = root.where_is("solver");
  if (!c.garments.empty())
    diagnostics.error(where, "path = \"arc length\" is for loads on a body, and here a garment tightens", "leave path out");
  for (const SupportSpec& support : c.support)
    if (support.moves())
      diagnostics.error(support.where, "a support that moves needs no path = \"arc length\": its force may fall as it goes",
                        "leave path out, or load the body with forces alone");
}

/// Particles give the shape of one garment.
void check_particles(const Case& c, const Table& root, Diagnostics& diagnostics) {
  const Location where = root.where_is("solver");
  if (c.garments.empty()) diagnostics.error(where, "tier particle lets a garment fall, and the case has none", "add [garment] and [contact], or take another tier");
  if (c.garments.size() > 1)
    diagnostics.error(c.garments[1].where, "tier particle has one garment, whose cloth meets the skin alone", "leave the others out, or take tier L1");
  if (c.comfort) diagnostics.error(root.where_is("comfort"), "tier particle gives the shape of cloth and no pressures to judge", "leave [comfort] out, or take tier L1 or L4");
}

void check_tier(const Case& c, const Table& root, Diagnostics& diagnostics) {
  if (c.solver.tier == Tier::L4) return;
  if (c.solver.tier == Tier::particle) check_particles(c, root, diagnostics);
  if (root.find("load"))
    diagnostics.error(root.where_is("load"),
                      fmt::format("tier {} has a rigid body, which no [load] deforms", text_of(c.solver.tier)),
                      "use tier L4 or leave [load] out");
  for (const SupportSpec& support : c.support)
    if (support.moves())
      diagnostics.error(support.where, fmt::format("tier {} has a rigid body, which no [[support]] moves", text_of(c.solver.tier)),
                        "use tier L4 or leave the support out");
}

}  // namespace

void complete(Case& description, const Table& root) {
  const auto names_file = [](const Table* garment) {  // even one that is not there
    const Value* pattern = garment ? garment->find("pattern") : nullptr;
    return pattern && (pattern->text() || (pattern->table() && pattern->table()->find("file")));
  };
  for (std::size_t g = 0; g < description.garments.size(); ++g)
    if (names_file(garment_table(root, g))) description.garments[g].pattern.kind = PatternKind::sewn;
  const Table* body = root.table("body");
  const Value* given = body ? body->find("layers") : nullptr;
  if (!description.body || !given || !given->array()) return;
  std::vector<LayerSpec>& layers = description.body->layers;
  for (std::size_t n = 0; n < layers.size() && n < given->array()->size(); ++n) {
    const Table* table = (*given->array())[n].table();
    if (!table || table->find("form")) continue;
    const bool skin = n > 0 && n + 1 == layers.size() && layers[n].thickness;
    layers[n].form = layers[n].material.name == "rigid" ? LayerForm::rigid : skin ? LayerForm::membrane : LayerForm::solid;
  }
}

void check_case(const Case& description, const Table& root, Diagnostics& diagnostics) {
  check_presence(description, root, diagnostics);
  if (description.body)
    if (const Table* body = root.table("body")) check_body(*description.body, *body, diagnostics);
  check_garments(description, root, diagnostics);
  check_contacts(description, diagnostics);
  check_loads(description, root, diagnostics);
  check_supports(description, diagnostics);
  check_tools(description, diagnostics);
  check_postures(description, diagnostics);
  check_tier(description, root, diagnostics);
  check_path(description, root, diagnostics);
  check_reference(description, root, diagnostics);
  if (description.body && description.comfort && description.body->locations.empty())
    diagnostics.error(root.where_is("comfort"), "[comfort] has no locations to judge",
                      "add [[body.locations]] named like the sensation curves, e.g. \"Front thigh\"");
}

}  // namespace snug::input
