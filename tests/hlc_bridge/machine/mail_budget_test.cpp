#include "hlc_bridge/machine/mail_budget.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace hlc::machine {
namespace {

constexpr MailBudget::Publisher kFlooding{1};
constexpr MailBudget::Publisher kOther{2};

std::size_t num_admitted(MailBudget& budget, const MailBudget::Publisher& publisher,
                         std::size_t bytes) {
  std::size_t admitted = 0;
  while (budget.admits(publisher, bytes)) ++admitted;
  return admitted;
}

TEST(MailBudget, OfLongMessagesOfOnePublisherIsItsBytes) {
  constexpr std::size_t kBytes = 60'000;
  MailBudget budget;
  const std::size_t admitted = num_admitted(budget, kFlooding, kBytes);
  EXPECT_GT(admitted, 100U);
  EXPECT_LE(admitted * kBytes, MailBudget::kMostBytes);
}

// The late joiner of a run of 20 cars receives their reports, some thousand of each at once.
TEST(MailBudget, HasRoomForManyShortMessagesOfEachOfManyPublishers) {
  MailBudget budget;
  EXPECT_GT(num_admitted(budget, kFlooding, 200), 4000U);
  budget.reset();
  for (std::uint8_t vehicle = 1; vehicle <= 20; ++vehicle) {
    for (int message = 0; message < 500; ++message) {
      EXPECT_TRUE(budget.admits({vehicle}, 1000)) << int{vehicle};
    }
  }
}

TEST(MailBudget, IsNotUsedUpByAnotherPublisher) {
  MailBudget budget;
  static_cast<void>(num_admitted(budget, kFlooding, 1));
  EXPECT_FALSE(budget.admits(kFlooding, 1));
  EXPECT_TRUE(budget.admits(kOther, 1));
}

TEST(MailBudget, OfAllPublishersTogetherIsBoundedToo) {
  MailBudget budget;
  std::size_t bytes = 0;
  for (std::uint8_t publisher = 1; publisher <= 200; ++publisher) {
    bytes += 1000 * num_admitted(budget, {publisher}, 1000);
  }
  EXPECT_LE(bytes, MailBudget::kMostBytesOfAll);
}

TEST(MailBudget, IsWholeAgainWhenTheMailIsRead) {
  MailBudget budget;
  const std::size_t admitted = num_admitted(budget, kFlooding, 1000);
  budget.reset();
  EXPECT_EQ(num_admitted(budget, kFlooding, 1000), admitted);
}

}  // namespace
}  // namespace hlc::machine
