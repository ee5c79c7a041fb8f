#include "fairway/simulate/value_spread.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fairway/base/error.hpp"
#include "fairway/base/random.hpp"

namespace fairway {
namespace {

TEST(ValueSpread, KnowsWhatNinetyFivePercentDoNotExceed) {
  std::vector<double> values;
  for (int i = 100; i >= 1; --i) values.push_back(i);
  EXPECT_EQ(spread_of(values), (Spread{100, 50.5, 95.0, 100.0}));
  EXPECT_EQ(spread_of({3.0}), (Spread{1, 3.0, 3.0, 3.0}));
  EXPECT_EQ(spread_of({}), Spread{});
}

TEST(ValueSpread, CountsInBinsAsNearAsItSays) {
  Random random(72);
  for (int round = 0; round < 40; ++round) {
    std::vector<double> values;
    SpreadCounter whole;
    SpreadCounter parts[2];
    const std::size_t count = 1 + random.below(2000);
    const double size = std::pow(10.0, random.uniform(-8.0, 7.0));
    for (std::size_t i = 0; i < count; ++i) {
      values.push_back(random.below(10) == 0 ? 0.0 : size * random.uniform(0.0, 1.0));
      whole.add(values.back());
      parts[random.below(2)].add(values.back());
    }
    parts[0].merge(parts[1]);
    const Spread exact = spread_of(values);
    for (const Spread& found : {whole.spread(), parts[0].spread()}) {
      EXPECT_EQ(found.count, count);
      EXPECT_NEAR(found.mean, exact.mean, 1e-12 * size);
      EXPECT_EQ(found.worst, exact.worst);
      EXPECT_GE(found.p95, exact.p95);
      EXPECT_LE(found.p95, std::max(exact.p95 * (1.0 + 1.0 / 64.0) * (1.0 + 1e-12), 1e-6));
    }
    EXPECT_EQ(parts[0].spread().p95, whole.spread().p95);
  }
}

TEST(ValueSpread, RefusesWhatCannotBeCounted) {
  SpreadCounter counter;
  EXPECT_THROW(counter.add(-1.0), PreconditionViolation);
  EXPECT_THROW(counter.add(std::nan("")), PreconditionViolation);
  counter.add(1e300);
  EXPECT_EQ(counter.spread().worst, 1e300);
  EXPECT_EQ(SpreadCounter().spread(), Spread{});
}

}  // namespace
}  // namespace fairway
