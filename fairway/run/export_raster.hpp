// Plans and verdicts as GeoTIFF: what GIS programs open.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "fairway/base/atomic_file.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/certificate/certificate.hpp"
#include "fairway/map/write_geotiff.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/simulate/flight_files.hpp"

namespace fairway {

/// The frame in a plan's or a certificate's record_json; that of no other place than the grid's own
/// when there is none. Throws InputError{where, ...} when it is there but damaged.
[[nodiscard]] WorldPlace world_place_of(const std::string& record_json, const std::string& where);

/// Degrees on Earth of a point of the plan's frame, by its tangent plane or its projection; empty
/// when its map had no place on Earth.
[[nodiscard]] LonLatOf lon_lat_of(const Plan& plan, const std::string& where);

/// Bands heading (rad), cost (m), region (code), as floats. No command, no way to the goal: no
/// value.
void export_plan(const Plan& plan, const std::string& where, const std::filesystem::path& path,
                 Existing existing);

/// A band of bytes for each heading, at least one: the verdicts of verdicts_at(), by code.
void export_verdicts(const Certificate& certificate, const std::string& where,
                     std::span<const Heading> headings, const std::filesystem::path& path,
                     Existing existing);

/// `count` headings, evenly spaced, the first east.
[[nodiscard]] std::vector<Heading> even_headings(int count);

}  // namespace fairway
