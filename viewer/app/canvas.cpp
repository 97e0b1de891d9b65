#include "viewer/app/canvas.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "viewer/gpu/context.h"

namespace sdf::viewer {
namespace {

constexpr int kRgba = 4, kRgb = 3;

double secondsNow() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A side.
int samplesAtRestOf(const Session& session) {
  return std::max(session.controls.samples, usefulSamples(session.renderer().shaders().plan));
}

int scaled(int pixels, double scale) { return std::max(1, static_cast<int>(std::lround(pixels * scale))); }

Picture withoutAlpha(const Picture& picture) {
  Picture result{picture.width, picture.height, kRgb, {}};
  for (std::size_t i = 0; i < picture.bytes.size(); ++i)
    if (i % kRgba != kRgb) result.bytes.push_back(picture.bytes[i]);
  return result;
}

}  // namespace

// Slower frames count at once, so that one slow frame is followed by a fast one; faster ones by half, so that
// the resolution does not jump about.
void Pace::drew(double seconds, double rays) {
  const double whole = seconds / rays;
  wholeFrame_ = whole > wholeFrame_ ? whole : 0.5 * (wholeFrame_ + whole);
}

double Pace::scale() const {
  if (wholeFrame_ <= kBudget) return 1.0;
  const double halvings = std::ceil(std::log2(wholeFrame_ / kBudget));  // of the pixels
  return std::max(std::exp2(-0.5 * halvings), kCoarsest);
}

Result<bool> Canvas::update(Session& session, int width, int height, double now) {
  if (width < 1 || height < 1) return false;
  const Shown wanted{session.controls, session.compilations(), width, height};
  const bool first = !shown_, changed = shown_ != wanted;
  if (changed) lastChange_ = now;
  if (!changed && now - lastChange_ < kStill) return false;
  if (!changed && whole_) {
    const int before = statistics_.refined;
    for (const double start = secondsNow(); !resting() && secondsNow() - start < kRefining;)
      if (const Status refined = refine(session); !refined) return refined.error();
    return statistics_.refined > before;
  }
  const bool moving = changed && !first;
  shown_ = wanted;
  if (const Status drawn = draw(session, moving ? pace_.scale() : 1.0, moving ? 1 : session.controls.samples);
      !drawn)
    return drawn.error();
  return true;
}

Status Canvas::draw(Session& session, double scale, int samples) {
  const int width = scaled(shown_->width, scale), height = scaled(shown_->height, scale);
  if (const Status made = ensure(target_, width, height, {PixelFormat::Rgba8}); !made) return made;
  Frame frame = session.frame();
  frame.samples = samples;
  const double start = secondsNow();
  if (const Status drawn = session.renderer().draw(frame, *target_); !drawn) return drawn;
  finish();
  statistics_ = {width, height, samples, secondsNow() - start, 0, {}, {}};
  const int atRest = samplesAtRestOf(session);
  samplesAtRest_ = atRest * atRest;
  const double rays = double(width) * height * samples * samples;
  pace_.drew(statistics_.seconds, rays / (double(shown_->width) * shown_->height));
  whole_ = scale == 1.0 && samples == session.controls.samples;
  if (!whole_) return okStatus();

  const auto picture = target_->picture();  // also where a lost context shows
  if (!picture) return picture.error();
  const double pixels = double(width) * height;
  statistics_.outOfSteps = static_cast<double>(pixelsOutOfSteps(*picture)) / pixels;
  statistics_.outOfShadowSteps = static_cast<double>(pixelsOutOfShadowSteps(*picture)) / pixels;
  return okStatus();
}

Status Canvas::refine(Session& session) {
  if (const Status made = ensure(refined_, target_->width(), target_->height(), {PixelFormat::Rgba8}); !made)
    return made;
  Frame frame = session.frame();
  frame.samples = samplesAtRestOf(session);
  if (const Status drawn = session.renderer().refine(frame, statistics_.refined, *refined_); !drawn)
    return drawn;
  finish();
  ++statistics_.refined;
  if (statistics_.refined > statistics_.samples * statistics_.samples) std::swap(target_, refined_);
  return okStatus();
}

void Canvas::show() const {
  if (target_) target_->show(shown_->width, shown_->height);
}

Result<Picture> Canvas::picture(Session& session) {
  if (!shown_) return Error{ErrorKind::Limits, "there is no picture yet"};
  if (!whole_)
    if (const Status drawn = draw(session, 1.0, session.controls.samples); !drawn) return drawn.error();
  while (!resting())
    if (const Status refined = refine(session); !refined) return refined.error();
  const auto picture = target_->picture();
  if (!picture) return picture.error();
  return withoutAlpha(*picture);
}

}  // namespace sdf::viewer
