// What the shipped comfort data offer, for snug list, snug explain and snug score --fit.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "postproc/comfort/membership_fit.hpp"
#include "postproc/comfort/sensation.hpp"

namespace snug::app {

/// Every shipped set of curves or bands and every fuzzy system, a line each.
std::string curves_text();
/// The same for --json: name, source, patch, population, locations of curves or ranges in Pa; null: no bound.
nlohmann::ordered_json curves_json();

/// The page of one shipped set: citation, patch, population, notes, its curves with their statistics, its bands.
/// Empty when there is none of that name.
std::string curves_page(const std::string& name);

/// Slope, intercept, R2, standard error, p and n of every curve.
std::string statistics_text(const postproc::SensationCurves& curves);

/// Half widths and slopes of the memberships, before and after.
std::string memberships_text(const postproc::MembershipFit& fit);

}  // namespace snug::app
