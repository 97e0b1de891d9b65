#include "sdf/font/text_outline.h"

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H
#include <hb-ot.h>
#include <hb.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string_view>
#include <vector>

#include "sdf/base/read_file.h"
#include "sdf/base/utf8.h"

namespace sdf {
namespace {

template <auto destroy>
struct Destroy {
  template <class T>
  void operator()(T* object) const {
    destroy(object);
  }
};
using Library = std::unique_ptr<FT_LibraryRec_, Destroy<FT_Done_FreeType>>;
using Face = std::unique_ptr<FT_FaceRec_, Destroy<FT_Done_Face>>;
using Blob = std::unique_ptr<hb_blob_t, Destroy<hb_blob_destroy>>;
using ShapingFace = std::unique_ptr<hb_face_t, Destroy<hb_face_destroy>>;
using ShapingFont = std::unique_ptr<hb_font_t, Destroy<hb_font_destroy>>;
using Buffer = std::unique_ptr<hb_buffer_t, Destroy<hb_buffer_destroy>>;

Error sceneError(const std::string& message) { return {ErrorKind::Scene, message}; }

/// An open font, as FreeType and as HarfBuzz read it.
struct Font {
  std::unique_ptr<const std::string> bytes;  // which the others read
  Library library;
  Face face;
  ShapingFont shaping;
  double unit = 0.0;  // of the font's coordinates
};

void openForShaping(const FontFile& file, Font& font) {
  const Blob blob(hb_blob_create(font.bytes->data(), static_cast<unsigned>(font.bytes->size()),
                                 HB_MEMORY_MODE_READONLY, nullptr, nullptr));
  const ShapingFace face(hb_face_create(blob.get(), static_cast<unsigned>(file.index)));
  font.shaping.reset(hb_font_create(face.get()));
  const int units = font.face->units_per_EM;
  hb_font_set_scale(font.shaping.get(), units, units);
}

Result<Font> openFont(const FontFile& file) {
  constexpr std::uintmax_t kMostFontBytes = 100'000'000;
  Result<std::string> bytes = readFile(file.path, kMostFontBytes, "choose another font");
  if (!bytes) return bytes.error();
  Font font;
  font.bytes = std::make_unique<const std::string>(std::move(*bytes));
  FT_Library library = nullptr;
  if (FT_Init_FreeType(&library) != 0) return Error{ErrorKind::Limits, "FreeType cannot be started"};
  font.library.reset(library);
  FT_Face face = nullptr;
  const FT_Error failed = FT_New_Memory_Face(library, reinterpret_cast<const FT_Byte*>(font.bytes->data()),
                                             static_cast<FT_Long>(font.bytes->size()), file.index, &face);
  if (failed != 0) return unreadable(file.path, "it is no font, or a broken one; choose another");
  font.face.reset(face);
  if (!FT_IS_SCALABLE(face) || !FT_IS_SFNT(face) || face->units_per_EM == 0)
    return unreadable(file.path,
                      "it is no TrueType or OpenType font with outlines; choose one that has them");
  font.unit = 1.0 / face->units_per_EM;
  openForShaping(file, font);
  return font;
}

/// Writes the curves of glyphs.
class GlyphWriter {
 public:
  GlyphWriter(const Font& font, Outline& out) : font_(font), out_(out) {}

  Status write(unsigned glyph, const glm::dvec2& at) {
    at_ = at;
    FT_Face face = font_.face.get();
    const bool isLoaded = FT_Load_Glyph(face, glyph, FT_LOAD_NO_SCALE | FT_LOAD_NO_BITMAP) == 0;
    if (!isLoaded || face->glyph->format != FT_GLYPH_FORMAT_OUTLINE)
      return Error{ErrorKind::Files, "a letter has no outline, or a broken one; choose another font"};
    FT_Outline_Funcs calls{};
    calls.move_to = [](const FT_Vector* to, void* self) { return of(self).moveTo(*to); };
    calls.line_to = [](const FT_Vector* to, void* self) {
      return of(self).curveTo({0, {}, of(self).place(*to)});
    };
    calls.conic_to = [](const FT_Vector* a, const FT_Vector* to, void* self) {
      return of(self).curveTo({1, {of(self).place(*a)}, of(self).place(*to)});
    };
    calls.cubic_to = [](const FT_Vector* a, const FT_Vector* b, const FT_Vector* to, void* self) {
      return of(self).curveTo({2, {of(self).place(*a), of(self).place(*b)}, of(self).place(*to)});
    };
    if (FT_Outline_Decompose(&face->glyph->outline, &calls, this) != 0)
      return Error{ErrorKind::Files, "the outline of a letter is broken; choose another font"};
    return okStatus();
  }

 private:
  static GlyphWriter& of(void* self) { return *static_cast<GlyphWriter*>(self); }
  glm::dvec2 place(const FT_Vector& v) const {
    return at_ + font_.unit * glm::dvec2(static_cast<double>(v.x), static_cast<double>(v.y));
  }
  int moveTo(const FT_Vector& to) {
    out_.contours.push_back({place(to), {}});
    return 0;
  }
  int curveTo(const Curve& curve) {
    out_.contours.back().curves.push_back(curve);
    return 0;
  }

  const Font& font_;
  Outline& out_;
  glm::dvec2 at_{};
};

// The character that begins at a byte, as a message names it: 'é' (U+00E9).
std::string characterAt(std::string_view text, std::size_t at) {
  const auto lead = static_cast<unsigned char>(text[at]);
  const std::size_t size = lead < 0x80 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
  unsigned code = size == 1 ? lead : lead & (0x7Fu >> size);
  for (std::size_t i = 1; i < size; ++i)
    code = code << 6 | (static_cast<unsigned char>(text[at + i]) & 0x3Fu);
  char number[16];
  std::snprintf(number, sizeof number, "U+%04X", code);
  const bool isShown = code >= 0x20 && code != 0x7F;
  return (isShown ? "'" + std::string(text.substr(at, size)) + "' (" : "(") + number + ")";
}

Status checkText(const std::string& text) {
  if (text.empty()) return sceneError("the text is empty; write some");
  if (text.size() > kMostTextBytes)
    return sceneError("the text has " + std::to_string(text.size()) + " bytes, and up to " +
                      std::to_string(kMostTextBytes) + " are taken; write it in several");
  const std::string good = utf8(text);
  if (good != text) {
    const auto at = std::ranges::mismatch(text, good).in1 - text.begin();
    return sceneError("the text is no UTF-8 at its byte " + std::to_string(at + 1) +
                      "; save the scene as UTF-8");
  }
  for (std::size_t i = 0; i < text.size(); ++i)
    if (const auto c = static_cast<unsigned char>(text[i]); c != '\n' && (c < 0x20 || c == 0x7F))
      return sceneError("the text has the control character " + characterAt(text, i) +
                        "; of those only \"\\n\" is taken, which begins a line");
  return okStatus();
}

/// A line of text, shaped.
struct Line {
  Buffer buffer;
  double width = 0.0;  // with spacing between letters, in font sizes
};

class TextSetter {
 public:
  TextSetter(const FontFile& file, const Font& font, const TextStyle& style)
      : file_(file), font_(font), style_(style) {}

  Result<Outline> set(const std::string& text) {
    const double height = style_.lineSpacing * font_.face->height * font_.unit;
    int number = 0;
    for (std::size_t from = 0; from <= text.size(); ++number) {
      const std::size_t end = std::min(text.find('\n', from), text.size());
      const Status status = setLine(text.substr(from, end - from), number, -height * number);
      if (!status) return status.error();
      from = end + 1;
    }
    if (outline_.contours.empty()) return sceneError("the text has nothing to be seen; write letters");
    return std::move(outline_);
  }

 private:
  Status setLine(const std::string& text, int number, double y) {
    const Line line = shaped(text);
    unsigned count = 0;
    const hb_glyph_info_t* glyphs = hb_buffer_get_glyph_infos(line.buffer.get(), &count);
    const hb_glyph_position_t* places = hb_buffer_get_glyph_positions(line.buffer.get(), &count);
    const double share = style_.align == TextStyle::Align::Left    ? 0.0
                         : style_.align == TextStyle::Align::Right ? 1.0
                                                                   : 0.5;
    glm::dvec2 pen(-share * line.width, y);
    GlyphWriter writer(font_, outline_);
    for (unsigned i = 0; i < count; ++i) {
      if (glyphs[i].codepoint == 0)
        return sceneError("the font " + file_.path.filename().string() + " has no letter " +
                          characterAt(text, glyphs[i].cluster) + ", in line " + std::to_string(number + 1) +
                          " of the text; choose a font that has it");
      const glm::dvec2 offset(places[i].x_offset, places[i].y_offset);
      const Status status = writer.write(glyphs[i].codepoint, pen + font_.unit * offset);
      if (!status) return Error{status.error().kind, unreadable(file_.path, status.error().message).message};
      pen += font_.unit * glm::dvec2(places[i].x_advance, places[i].y_advance);
      if (i + 1 < count && glyphs[i + 1].cluster != glyphs[i].cluster) pen.x += style_.spacing;
    }
    return okStatus();
  }

  Line shaped(const std::string& text) const {
    Line line{Buffer(hb_buffer_create())};
    hb_buffer_t* buffer = line.buffer.get();
    hb_buffer_add_utf8(buffer, text.data(), static_cast<int>(text.size()), 0, static_cast<int>(text.size()));
    hb_buffer_guess_segment_properties(buffer);
    if (!HB_DIRECTION_IS_HORIZONTAL(hb_buffer_get_direction(buffer)))
      hb_buffer_set_direction(buffer, HB_DIRECTION_LTR);
    std::vector<hb_feature_t> features;
    if (style_.spacing != 0.0)
      for (const hb_tag_t tag : {HB_TAG('l', 'i', 'g', 'a'), HB_TAG('c', 'l', 'i', 'g')})
        features.push_back({tag, 0, HB_FEATURE_GLOBAL_START, HB_FEATURE_GLOBAL_END});
    hb_shape(font_.shaping.get(), buffer, features.data(), static_cast<unsigned>(features.size()));
    unsigned count = 0;
    const hb_glyph_info_t* glyphs = hb_buffer_get_glyph_infos(buffer, &count);
    const hb_glyph_position_t* places = hb_buffer_get_glyph_positions(buffer, &count);
    for (unsigned i = 0; i < count; ++i) {
      line.width += font_.unit * places[i].x_advance;
      if (i + 1 < count && glyphs[i + 1].cluster != glyphs[i].cluster) line.width += style_.spacing;
    }
    return line;
  }

  const FontFile& file_;
  const Font& font_;
  const TextStyle& style_;
  Outline outline_;
};

}  // namespace

Result<Outline> textOutline(const std::string& text, const FontFile& file, const TextStyle& style) {
  if (const Status good = checkText(text); !good) return good.error();
  const Result<Font> font = openFont(file);
  if (!font) return font.error();
  return TextSetter(file, *font, style).set(text);
}

}  // namespace sdf
