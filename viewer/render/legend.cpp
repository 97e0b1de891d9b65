#include "viewer/render/legend.h"

#include <imgui/imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "viewer/shaders/error_colors.h"

namespace sdf::viewer {
namespace {

// In pixels at scale 1.
constexpr int kLetter = 13, kLine = 15, kMargin = 10;
constexpr int kBar = 5;  // of the histogram: the width of a bin
constexpr int kBars = static_cast<int>(ErrorFigures::kBins) + 2, kGap = 4;  // before what is beyond
constexpr int kWide = kBars * kBar + 2 * kGap, kHistogram = 44, kColors = 12;
constexpr int kAside = 20;  // room for the numbers at the ends
constexpr int kWidth = kWide + 2 * (kMargin + kAside);

/// A picture with straight alpha that is drawn into.
class Sheet {
 public:
  Sheet(int width, int height, int scale) : scale_(scale), picture_{scale * width, scale * height, 4, {}} {
    picture_.bytes.resize(static_cast<std::size_t>(4 * picture_.width * picture_.height));
    ImFontConfig config;
    config.SizePixels = static_cast<float>(kLetter * scale);
    config.OversampleH = 1;
    config.PixelSnapH = true;
    font_ = atlas_.AddFontDefault(&config);
    atlas_.GetTexDataAsAlpha8(&letters_, &lettersWidth_, &lettersHeight_);
  }

  void fill(int x, int y, int width, int height, const glm::vec4& color) {
    for (int row = scale_ * y; row < scale_ * (y + height); ++row)
      for (int column = scale_ * x; column < scale_ * (x + width); ++column) put(column, row, color, color.a);
  }

  int widthOf(const std::string& text) const {
    float width = 0.0f;
    for (const char c : text) width += font_->FindGlyph(static_cast<ImWchar>(c))->AdvanceX;
    return static_cast<int>(width) / scale_;
  }

  void write(int x, int y, const std::string& text, const glm::vec4& color) {
    float pen = static_cast<float>(scale_ * x);
    for (const char c : text) {
      const ImFontGlyph& glyph = *font_->FindGlyph(static_cast<ImWchar>(c));
      const int left = static_cast<int>(pen + glyph.X0), top = scale_ * y + static_cast<int>(glyph.Y0);
      const int u = static_cast<int>(std::lround(glyph.U0 * static_cast<float>(lettersWidth_)));
      const int v = static_cast<int>(std::lround(glyph.V0 * static_cast<float>(lettersHeight_)));
      for (int row = 0; row < static_cast<int>(glyph.Y1 - glyph.Y0); ++row)
        for (int column = 0; column < static_cast<int>(glyph.X1 - glyph.X0); ++column)
          put(left + column, top + row, color,
              static_cast<float>(letters_[(v + row) * lettersWidth_ + u + column]) / 255.0f);
      pen += glyph.AdvanceX;
    }
  }
  void writeCentred(int middle, int y, const std::string& text, const glm::vec4& color) {
    write(middle - widthOf(text) / 2, y, text, color);
  }

  Picture picture() && { return std::move(picture_); }

 private:
  void put(int x, int y, const glm::vec4& color, float alpha) {
    if (x < 0 || y < 0 || x >= picture_.width || y >= picture_.height) return;
    std::uint8_t* p = &picture_.bytes[static_cast<std::size_t>(4 * (y * picture_.width + x))];
    const float below = static_cast<float>(p[3]) / 255.0f, both = alpha + below * (1.0f - alpha);
    if (both == 0.0f) return;
    for (int k = 0; k < 3; ++k)
      p[k] = static_cast<std::uint8_t>(std::lround(
          (alpha * color[k] * 255.0f + (1.0f - alpha) * below * static_cast<float>(p[k])) / both));
    p[3] = static_cast<std::uint8_t>(std::lround(255.0f * both));
  }

  int scale_;
  Picture picture_;
  ImFontAtlas atlas_;
  ImFont* font_ = nullptr;
  unsigned char* letters_ = nullptr;
  int lettersWidth_ = 0, lettersHeight_ = 0;
};

const glm::vec4 kBack(0.08f, 0.08f, 0.09f, 0.82f), kBright(0.95f, 0.95f, 0.95f, 1.0f),
    kDim(0.7f, 0.7f, 0.72f, 1.0f);

std::string text(const char* format, double value) {
  char buffer[48];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

// Where a bin's bar begins; what is beyond stands apart.
int placeOf(int bin) {
  return kMargin + kAside + bin * kBar + (bin > 0 ? kGap : 0) + (bin + 1 == kBars ? kGap : 0);
}

glm::vec4 colorOf(int bin) {
  constexpr double kBins = ErrorFigures::kBins;
  return {errorColor(2.0 * (bin - 0.5) / kBins - 1.0), 1.0f};
}

// Bars as high as the square root of their shares, so that few are seen beside many.
void drawHistogram(const ErrorFigures& figures, int bottom, Sheet& sheet) {
  const double most = std::ranges::max(figures.histogram);
  for (int bin = 0; bin < kBars; ++bin) {
    const double share = figures.histogram[static_cast<std::size_t>(bin)];
    int height = most > 0.0 ? static_cast<int>(std::lround(kHistogram * std::sqrt(share / most))) : 0;
    if (share > 0.0) height = std::max(height, 1);
    sheet.fill(placeOf(bin), bottom - height, kBar - 1, height, kBright);
    sheet.fill(placeOf(bin), bottom + 2, kBar, kColors, colorOf(bin));
  }
}

}  // namespace

Picture legendOf(const ErrorFigures& figures, int scale) {
  const bool compares = figures.tolerance > 0.0;
  const int bottom = kMargin + kLine + kHistogram, below = bottom + kColors + 5;
  const int lines = compares ? 5 : 3;
  Sheet sheet(kWidth, below + lines * kLine + kMargin - 2, scale);
  sheet.fill(0, 0, kWidth, below + lines * kLine + kMargin - 2, kBack);
  sheet.write(kMargin, kMargin - 2, "mesh to surface: - inside, + outside", kBright);
  drawHistogram(figures, bottom, sheet);
  const int first = placeOf(1), width = kBar * static_cast<int>(ErrorFigures::kBins);
  for (const double tick : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
    const int x = first + static_cast<int>(std::lround(0.5 * (tick + 1.0) * width));
    sheet.fill(x, bottom + 2 + kColors, 1, 3, kBright);
    if (std::abs(tick) == 0.5) continue;
    sheet.writeCentred(x, below, tick == 0.0 ? "0" : text("%+.3g", tick * figures.limit), kBright);
    if (compares) sheet.writeCentred(x, below + kLine, tick == 0.0 ? "tolerance" : text("%+.3g", tick), kDim);
  }
  int line = below + (compares ? 2 : 1) * kLine;
  const auto say = [&](const std::string& words) { sheet.write(kMargin, line, words, kDim), line += kLine; };
  say(text("%+.3g", figures.least) + text(" to %+.3g", figures.most) + text(", rms %.3g", figures.rms));
  if (compares)
    say(text("%+.2f", figures.least / figures.tolerance) +
        text(" to %+.2f", figures.most / figures.tolerance) +
        text(", rms %.2f tolerances", figures.rms / figures.tolerance));
  say(text("%.2g %% of the area beyond, ", 100.0 * figures.beyond()) + std::to_string(figures.triangles) +
      " triangles");
  return std::move(sheet).picture();
}

void drawLegend(const ErrorFigures& figures, Picture& picture) {
  constexpr int kHeightAtOne = 540;
  const Picture legend = legendOf(figures, std::max(1, picture.height / kHeightAtOne));
  const int space = kMargin, left = picture.width - legend.width - space,
            top = picture.height - legend.height - space;
  if (left < 0 || top < 0) return;
  for (int y = 0; y < legend.height; ++y)
    for (int x = 0; x < legend.width; ++x) {
      const std::uint8_t* from = &legend.bytes[static_cast<std::size_t>(4 * (y * legend.width + x))];
      std::uint8_t* to =
          &picture.bytes[static_cast<std::size_t>(picture.channels * ((top + y) * picture.width + left + x))];
      const float alpha = static_cast<float>(from[3]) / 255.0f;
      for (int k = 0; k < 3; ++k)
        to[k] = static_cast<std::uint8_t>(std::lround(glm::mix(float(to[k]), float(from[k]), alpha)));
    }
}

}  // namespace sdf::viewer
