#include "fairway/run/product_picture.hpp"

#include "fairway/certificate/certificate_file.hpp"
#include "fairway/certificate/contract_certificate_file.hpp"
#include "fairway/plan/plan_file.hpp"
#include "fairway/report/draw_plan.hpp"
#include "fairway/report/draw_verdicts.hpp"
#include "fairway/run/contract_failure_pictures.hpp"
#include "fairway/run/contract_pictures.hpp"
#include "fairway/run/product_file.hpp"
#include "fairway/verify/sample_verdicts.hpp"

namespace fairway {

Picture picture_of_plan(const Plan& plan, const std::string& title) {
  return draw_plan(plan, {.title = title, .mission = plan.record.mission});
}

ProductPicture picture_of_product(const std::filesystem::path& file) {
  const std::string title = file.stem().string();
  const ProductKind kind = product_kind(file);
  if (kind == ProductKind::plan) {
    return {picture_of_plan(read_plan(file), title), "plan"};
  }
  if (kind == ProductKind::contract_certificate) {
    const ContractCertificate certificate = read_contract_certificate(file);
    return {picture_of_verdicts(certificate, contract_verdict_map(certificate), title), "verdicts"};
  }
  const Certificate certificate = read_certificate(file);
  const VerdictMap map = verdict_map_of(certificate.view(), {});
  return {draw_verdicts(map, {.title = title}), "verdicts"};
}

void write_picture(const Picture& picture, const std::filesystem::path& file, Existing existing) {
  write_whole(file, existing, file.extension() == ".png" ? picture.png : picture.svg);
}

}  // namespace fairway
