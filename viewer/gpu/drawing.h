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

/// The sum of all.
class SumOfAll {
 public:
  SumOfAll();
  ~SumOfAll();
  SumOfAll(const SumOfAll&) = delete;
  SumOfAll& operator=(const SumOfAll&) = delete;
};

/// Into one layer only; the others stay as they are.
class OneLayer {
 public:
  explicit OneLayer(int layer);
  ~OneLayer();
  OneLayer(const OneLayer&) = delete;
  OneLayer& operator=(const OneLayer&) = delete;
};

}  // namespace sdf::viewer
