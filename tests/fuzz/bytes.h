// A fuzzer's input read as decisions and numbers. Every input means something: past its end all is 0.
#pragma once
#include <array>
#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <span>

namespace sdf::fuzz {

class Bytes {
 public:
  explicit Bytes(std::span<const std::uint8_t> data) : data_(data) {}

  bool empty() const { return data_.empty(); }
  unsigned byte() {
    if (data_.empty()) return 0;
    const unsigned b = data_.front();
    data_ = data_.subspan(1);
    return b;
  }
  bool flag() { return byte() & 1; }
  /// 0 <= result < n <= 256.
  int below(int n) { return static_cast<int>(byte()) % n; }
  template <class Word>
  Word word() {
    Word w = 0;
    for (std::size_t i = 0; i < sizeof(Word); ++i) w |= static_cast<Word>(byte()) << (8 * i);
    return w;
  }

  /// Within [-4, 4], a multiple of 1/32: small enough that creases and ties are often met.
  double moderate() { return (static_cast<int>(byte()) - 128) / 32.0; }
  /// Within (0, 4].
  double positive() { return (byte() + 1) / 64.0; }

  /// Any double, but most often a moderate one or one at which formulas break.
  double number() {
    static constexpr std::array kHostile = {0.0,
                                            -0.0,
                                            0.5,
                                            -1.0,
                                            1.0,
                                            1.57079632679489661923,
                                            3.14159265358979323846,
                                            HUGE_VAL,
                                            -HUGE_VAL,
                                            std::bit_cast<double>(0x7FF8000000000000u),
                                            DBL_MAX,
                                            -DBL_MAX,
                                            DBL_MIN,
                                            DBL_TRUE_MIN,
                                            -DBL_TRUE_MIN,
                                            DBL_EPSILON,
                                            static_cast<double>(FLT_MAX),
                                            static_cast<double>(FLT_MIN),
                                            1e-160,
                                            1e160,
                                            88.75,
                                            -104.0,
                                            38999.0,
                                            39001.0,
                                            16777217.0,
                                            1e9,
                                            1e16};
    switch (below(8)) {
      case 0:
        return kHostile[below(kHostile.size())];
      case 1:
        return std::bit_cast<double>(word<std::uint64_t>());
      case 2:
        return std::bit_cast<float>(word<std::uint32_t>());
      default:
        return moderate();
    }
  }

 private:
  std::span<const std::uint8_t> data_;
};

}  // namespace sdf::fuzz
