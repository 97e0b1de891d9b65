// How fragments that fall on one pixel are put together, while one of these lives. What counts otherwise is
// the last.
#pragma once

namespace sdf::viewer {

/// The one of the least depth. For targets with depth.
class NearestWins {
 public:
  NearestWins();
  ~NearestWins();
  NearestWins(const NearestWins&) = delete;
  NearestWins& operator=(const NearestWins&) = delete;
};

/// The sum of all, in one layer; the others stay as they are.
class SumOfAll {
 public:
  explicit SumOfAll(int layer);
  ~SumOfAll();
  SumOfAll(const SumOfAll&) = delete;
  SumOfAll& operator=(const SumOfAll&) = delete;
};

}  // namespace sdf::viewer
