#include "fairway/run/products.hpp"

#include "fairway/run/bitmap_pictures.hpp"
#include "fairway/run/contract_pictures.hpp"
#include "fairway/run/run_pictures.hpp"
#include "fairway/run/verdict_pictures.hpp"

namespace fairway {

std::vector<std::string> product_names() {
  std::vector<std::string> names{product::plan,
                                 product::flights_csv,
                                 product::flights_geojson,
                                 product::outcomes,
                                 product::certificate,
                                 product::bitmap,
                                 product::failures,
                                 product::report_page,
                                 product::summary,
                                 product::contract_certificate};
  for (const std::string picture : run_pictures) {
    names.push_back(picture + ".svg");
    names.push_back(picture + ".png");
  }
  for (std::string& file : verdict_picture_files()) names.push_back(std::move(file));
  for (std::string& file : bitmap_picture_files()) names.push_back(std::move(file));
  for (std::string& file : contract_picture_files()) names.push_back(std::move(file));
  return names;
}

}  // namespace fairway
