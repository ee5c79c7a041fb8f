// The names of a run's products.
#pragma once

#include <string>
#include <vector>

namespace fairway {

namespace product {
inline constexpr const char* plan = "plan.safetensors";
inline constexpr const char* flights_csv = "flights.csv";
inline constexpr const char* flights_geojson = "flights.geojson";
inline constexpr const char* outcomes = "outcomes.csv";
inline constexpr const char* certificate = "certificate.safetensors";
inline constexpr const char* contract_certificate = "contract.certificate.safetensors";
inline constexpr const char* bitmap = "bitmap.safetensors";
inline constexpr const char* failures = "failures.csv";
inline constexpr const char* report_page = "report.html";
inline constexpr const char* summary = "summary.json";
}  // namespace product

/// Every file that a run may write, including pictures: what a rerun may replace, and what
/// `fairway view` serves.
[[nodiscard]] std::vector<std::string> product_names();

}  // namespace fairway
