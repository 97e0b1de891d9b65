#include "sdf/base/fnv.h"

#include <gtest/gtest.h>

#include <string_view>

namespace sdf {
namespace fnv_test {

template <class Hash>
Hash hashOf(std::string_view text) {
  auto hash = kFnvBegin<Hash>;
  for (const char c : text) hash = fnv(hash, Hash{static_cast<unsigned char>(c)});
  return hash;
}

// The authors' test vectors (draft-eastlake-fnv, appendix C).
TEST(Fnv, IsTheAuthors) {
  EXPECT_EQ(hashOf<std::uint32_t>(""), 0x811c9dc5u);
  EXPECT_EQ(hashOf<std::uint32_t>("a"), 0xe40c292cu);
  EXPECT_EQ(hashOf<std::uint32_t>("foobar"), 0xbf9cf968u);
  EXPECT_EQ(hashOf<std::uint64_t>(""), 0xcbf29ce484222325u);
  EXPECT_EQ(hashOf<std::uint64_t>("a"), 0xaf63dc4c8601ec8cu);
  EXPECT_EQ(hashOf<std::uint64_t>("foobar"), 0x85944171f73967e8u);
}

}  // namespace fnv_test
}  // namespace sdf
