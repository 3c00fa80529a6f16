// The tables of the library's file and how a file of an earlier snug becomes one of today.
#pragma once

#include "materials/database/sqlite.hpp"

namespace snug::materials::sql {

/// The version that this program writes; that of a file stands in its header (user_version).
int schema_version();

/// Makes the tables where there are none; brings those of an earlier version up to date, after a copy of the file has
/// been put beside it (FILE.schema-N.backup). `upto`: the version to stop at, for tests. Throws input::InputError for a
/// damaged file, for one of another program and for one of a later snug; they are left as they are.
void bring_up_to_date(Connection& connection, int upto = schema_version());

/// Reads the whole file for damage; throws input::InputError when there is some.
void check_for_damage(const Connection& connection);

}  // namespace snug::materials::sql
