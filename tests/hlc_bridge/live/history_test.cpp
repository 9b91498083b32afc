#include "hlc_bridge/live/history.hpp"

#include <gtest/gtest.h>

namespace hlc::live {
namespace {

History with_events(int count) {
  History history("1234");
  for (int i = 0; i < count; ++i) history.append("[" + std::to_string(i) + "]");
  return history;
}

TEST(History, AnEventHasTheMessagesAndAnId) {
  EXPECT_EQ(with_events(2).event(1), "id: 1234-1\ndata: [1]\n\n");
}

TEST(History, AClientContinuesAfterItsLastEvent) {
  const History history = with_events(12);
  EXPECT_EQ(history.position_after("1234-0"), 1U);
  EXPECT_EQ(history.position_after("1234-11"), 12U);
}

TEST(History, AnIdThatIsNotOfThisHistoryMeansTheBegin) {
  const History history = with_events(3);
  for (const char* id : {"", "1234", "1234-", "1234-3", "1234--1", "1234-1x", "1234- 1", "123-1",
                         "12345-1", "1234-99999999999999999999999"}) {
    EXPECT_EQ(history.position_after(id), 0U) << id;
  }
}

TEST(History, EventsStayWhereTheyAre) {
  History history = with_events(1);
  const std::string* first = &history.event(0);
  for (int i = 0; i < 10'000; ++i) history.append("[]");
  EXPECT_EQ(first, &history.event(0)) << "a client may be reading it";
}

TEST(History, CountsItsBytes) {
  const History history = with_events(2);
  EXPECT_EQ(history.num_bytes(), history.event(0).size() + history.event(1).size());
}

}  // namespace
}  // namespace hlc::live
