#include "sdf/base/shared_list.h"

#include <gtest/gtest.h>

#include <string>
#include <thread>

namespace sdf {
namespace shared_list_test {

using List = SharedList<std::string>;

std::vector<std::string> all(const List& list) { return {list.begin(), list.end()}; }

TEST(SharedList, CopiesDoNotSeeWhatIsAddedToOneAnother) {
  List first;
  first.push_back("a");
  first.push_back("b");
  List second = first, third = first;
  second.push_back("c");
  third.push_back("d");
  EXPECT_EQ(all(first), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(all(second), (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_EQ(all(third), (std::vector<std::string>{"a", "b", "d"}));
}

TEST(SharedList, AppendsItself) {
  List list;
  for (const char* item : {"a", "b", "c"}) list.push_back(item);
  const List before = list;
  list.append(before);
  EXPECT_EQ(all(list), (std::vector<std::string>{"a", "b", "c", "a", "b", "c"}));
}

// Room for so many items, of all blocks that were ever made.
std::size_t roomMade = 0;
struct Room {
  explicit Room(std::size_t capacity) { roomMade += capacity; }
};

TEST(SharedList, GrowsByACopyOfTheLastInTimeOfTheWhole) {
  constexpr std::size_t kItems = 10'000;
  roomMade = 0;
  std::vector<SharedList<int, Room>> lists(1);
  for (std::size_t i = 0; i < kItems; ++i) {
    lists.push_back(lists.back());
    lists.back().push_back(static_cast<int>(i));
  }
  EXPECT_LT(roomMade, 4 * kItems);
  for (const std::size_t n : {std::size_t{1}, std::size_t{77}, kItems}) {
    EXPECT_EQ(lists[n].size(), n);
    EXPECT_EQ(lists[n][n - 1], static_cast<int>(n - 1));
  }
}

TEST(SharedList, IsAddedToByAnyThread) {
  List list;
  list.reserve(100);
  list.push_back("first");
  std::vector<List> lists(8, list);
  std::vector<std::thread> threads;
  for (List& own : lists)
    threads.emplace_back([&own] {
      for (int i = 0; i < 50; ++i) own.push_back(std::to_string(i));
    });
  for (std::thread& t : threads) t.join();
  for (const List& own : lists) {
    ASSERT_EQ(own.size(), 51u);
    EXPECT_EQ(own.front(), "first");
    EXPECT_EQ(own[50], "49");
  }
}

}  // namespace shared_list_test
}  // namespace sdf
