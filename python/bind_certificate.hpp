// A certificate that Python holds.
#pragma once

#include <memory>

#include "fairway/certificate/certificate.hpp"

namespace fairway::python {

struct HeldCertificate {
  const Certificate certificate;
};

}  // namespace fairway::python
