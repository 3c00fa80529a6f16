// The fields of a scene: named blocks of the state vector.
#pragma once

#include <string>
#include <vector>

namespace snug::solver {

/// What the residual of a field's entries is, and so what they are.
enum class Rows {
  force,       ///< N, of positions (m)
  constraint,  ///< a gap or a volume, of a multiplier or pressure (Pa): each has one negative pivot in a minimum
  cell,        ///< none: eliminated cell by cell, their step follows from that of the positions
};

/// A block of `count` items of `components` entries each. An empty one belongs to nothing.
struct Field {
  std::string name;
  Rows rows = Rows::force;
  int first = 0, count = 0, components = 1;
  bool non_negative = false;  ///< a prediction keeps it so

  int operator()(int item, int component = 0) const { return first + components * item + component; }
  int size() const { return components * count; }
  int end() const { return first + size(); }
};

/// Fields in the order in which they stand in the state vector: positions first.
class Layout {
 public:
  /// Throws std::logic_error where the name is taken, and for positions after other fields.
  Field add(Field field);
  /// The field of that name, or an empty one where the scene has none.
  const Field& operator[](const std::string& name) const;
  const std::vector<Field>& fields() const { return fields_; }
  /// Entries [0, positions()) are positions.
  int positions() const { return positions_; }
  int size() const { return fields_.empty() ? 0 : fields_.back().end(); }

 private:
  std::vector<Field> fields_;
  int positions_ = 0;
};

}  // namespace snug::solver
