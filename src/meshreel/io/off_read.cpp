/// Reading OFF: a first word, three counts, a line a vertex, a line a face.
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "meshreel/base/text.h"
#include "meshreel/io/attributes.h"
#include "meshreel/io/frames.h"
#include "meshreel/io/off.h"
#include "meshreel/io/sequence.h"
#include "meshreel/io/text_scan.h"

namespace meshreel::io {

namespace {

/// Colours of vertices or faces: bytes where all are whole numbers and some is above 1, otherwise fractions of 1.
struct Colors {
    std::vector<float> values;         ///< four a row, a row where a colour is given
    std::vector<std::uint8_t> lengths; ///< numbers given in each row: 3 or 4
    bool whole = true, above_one = false;

    std::uint32_t count() const { return static_cast<std::uint32_t>(lengths.size()); }
    Attribute attribute(std::string name, Domain domain, std::vector<std::uint32_t> indices) const;
};

Attribute Colors::attribute(std::string name, Domain domain, std::vector<std::uint32_t> indices) const
{
    const bool bytes = whole && above_one;
    const std::uint8_t components = std::ranges::max(lengths);
    Attribute all{std::move(name), domain, bytes ? Scalar::u8 : Scalar::f32, components, bytes, {}, std::move(indices)};
    for (std::size_t i = 0; i < lengths.size(); ++i)
        for (std::size_t c = 0; c < components; ++c) {
            const float value = c < lengths[i] ? values[i * 4 + c] : bytes ? 255.0f : 1.0f;
            if (bytes)
                all.values.push_back(static_cast<std::uint8_t>(value));
            else
                append_little(all.values, value);
        }
    return all;
}

class OffReader {
public:
    OffReader(ByteView bytes, const LoadOptions& options) : lines_(bytes), size_(bytes.size()), options_(options) {}
    Result<Animation> read();

private:
    Status header();
    Status first_word(std::string_view word);
    Result<std::uint64_t> count(std::string_view field);
    bool next_row();
    Status vertex();
    Status face();
    Result<float> number(std::string_view field);
    Status color(Colors& colors, std::string_view field, std::size_t most);
    void carry();
    void warn() const;
    Place here() const { return at_line(std::max<std::uint64_t>(lines_.line(), 1)); }

    LineScanner lines_;
    std::size_t size_;
    const LoadOptions& options_;
    Animation mesh_;
    bool has_uvs_ = false, has_colors_ = false, has_normals_ = false;
    std::string_view pending_; ///< a word of the header that is the first count
    std::uint64_t faces_ = 0, face_ = 0;
    std::vector<float> uvs_, normals_;
    Colors colors_, face_colors_;
    std::vector<std::uint32_t> color_of_, face_color_of_, polygon_;
    std::uint64_t polygons_ = 0, slivers_ = 0, extra_ = 0, mapped_ = 0;
};

/// Goes to the next line that says something.
bool OffReader::next_row()
{
    while (lines_.next_line()) {
        LineScanner look = lines_;
        if (!look.word().empty()) return true;
    }
    return false;
}

Status OffReader::first_word(std::string_view word)
{
    std::string_view rest = word;
    const auto take = [&rest](std::string_view prefix) {
        const bool found = rest.starts_with(prefix);
        if (found) rest.remove_prefix(prefix.size());
        return found;
    };
    has_uvs_ = take("ST");
    has_colors_ = take("C");
    has_normals_ = take("N");
    if (rest.starts_with("4") || rest.starts_with("n"))
        return unsupported(in_quotes(word) + " has not three dimensions", "signature");
    if (rest == "OFF") return Ok{};
    pending_ = word;
    if (to_integer(word) && rest == word) return Ok{}; // the first word may be missing
    return bad_input("this is no OFF file: it begins with " + in_quotes(word), "signature", here());
}

Result<std::uint64_t> OffReader::count(std::string_view field)
{
    std::string_view word = std::exchange(pending_, {});
    if (word.empty()) word = lines_.word();
    while (word.empty() && next_row()) word = lines_.word();
    const auto number = to_integer(word);
    if (!number || *number < 0) return bad_input(in_quotes(word) + " is not a count", std::string(field), here());
    return static_cast<std::uint64_t>(*number);
}

Status OffReader::header()
{
    if (!next_row()) return bad_input("the file is empty", "signature", here());
    MESHREEL_CHECK(first_word(lines_.word()));
    LineScanner look = lines_;
    if (look.word() == "BINARY") return unsupported("binary OFF files are not read", "signature");
    MESHREEL_TRY(const std::uint64_t vertices, count("vertex_count"));
    MESHREEL_TRY(faces_, count("face_count"));
    lines_.rest();                                                  // the number of edges, which nobody keeps right
    constexpr std::uint64_t smallest_vertex = 6, smallest_face = 2; // "0 0 0\n", "0\n"
    const std::uint64_t left = size_ - lines_.offset() + 1;
    if (vertices > left / smallest_vertex)
        return bad_input(concat(vertices, " vertices are promised, but ", left - 1, " bytes are left"), "vertex_count",
                         here());
    if (faces_ > left / smallest_face)
        return bad_input(concat(faces_, " faces are promised, but ", left - 1, " bytes are left"), "face_count",
                         here());
    MESHREEL_CHECK(within(options_.limits, vertices, faces_, 1));
    if (vertices == 0 || vertices >= no_value) return bad_input(concat(vertices, " vertices"), "vertex_count", here());
    mesh_.vertex_count = static_cast<std::uint32_t>(vertices);
    mesh_.positions.reserve(vertices * 3);
    return Ok{};
}

Result<float> OffReader::number(std::string_view field)
{
    const std::string_view word = lines_.word();
    const auto value = to_float(word);
    if (value) return *value;
    return bad_input(word.empty() ? "the line ends too early" : in_quotes(word) + " is not a number",
                     std::string(field), here());
}

/// Up to `most` numbers: the colour of a vertex or face.
Status OffReader::color(Colors& colors, std::string_view field, std::size_t most)
{
    float row[4] = {};
    std::uint8_t n = 0;
    for (; n < most; ++n) {
        const std::string_view word = lines_.word();
        if (word.empty()) break;
        const auto value = to_float(word);
        const auto integer = to_integer(word);
        if (!value) return bad_input(in_quotes(word) + " is not a number", std::string(field), here());
        colors.whole = colors.whole && integer && *integer >= 0 && *integer <= 255;
        colors.above_one = colors.above_one || *value > 1.0f;
        row[n] = *value;
    }
    if (n < 3) return bad_input(concat(n, " numbers are no colour"), std::string(field), here());
    colors.values.insert(colors.values.end(), row, row + 4);
    colors.lengths.push_back(n);
    return Ok{};
}

/// x y z, then normal, colour and texture coordinates as the first word said.
Status OffReader::vertex()
{
    for (std::size_t i = 0; i < 3; ++i) {
        MESHREEL_TRY(const float value, number("position"));
        mesh_.positions.push_back(value);
    }
    for (std::size_t i = 0; has_normals_ && i < 3; ++i) {
        MESHREEL_TRY(const float value, number("normal"));
        normals_.push_back(value);
    }
    if (has_colors_) {
        LineScanner look = lines_;
        std::size_t words = 0;
        while (words < 6 && !look.word().empty()) ++words;
        MESHREEL_CHECK(
            color(colors_, "color", std::min<std::size_t>(4, words - std::min<std::size_t>(words, has_uvs_ ? 2 : 0))));
    }
    for (std::size_t i = 0; has_uvs_ && i < 2; ++i) {
        MESHREEL_TRY(const float value, number("uv"));
        uvs_.push_back(value);
    }
    if (!lines_.word().empty()) ++extra_;
    return Ok{};
}

Status OffReader::face()
{
    MESHREEL_TRY(const std::uint64_t corners, count("face"));
    if (corners > (size_ - lines_.offset()) / 2 + 1)
        return bad_input(concat("a face of ", corners, " corners, but ", size_ - lines_.offset(), " bytes are left"),
                         "face", here());
    polygon_.clear();
    for (std::uint64_t i = 0; i < corners; ++i) {
        const std::string_view word = lines_.word();
        const auto index = to_integer(word);
        if (word.empty())
            return bad_input(concat("the line ends after ", i, " of ", corners, " corners"), "face", here());
        if (!index || *index < 0 || *index >= mesh_.vertex_count)
            return bad_input(concat(in_quotes(word), " is not one of the ", mesh_.vertex_count, " vertices"), "face",
                             here());
        polygon_.push_back(static_cast<std::uint32_t>(*index));
    }
    LineScanner look = lines_;
    const bool given = !look.word().empty(), full = given && !look.word().empty();
    if (given && !full) ++mapped_;
    if (full) MESHREEL_CHECK(color(face_colors_, "face color", 4));
    if (corners < 3) ++slivers_;
    if (corners > 3) ++polygons_;
    MESHREEL_CHECK(within(mesh_.triangles.size() + corners, options_.limits.max_triangles, "face"));
    for (std::size_t i = 2; i < polygon_.size(); ++i) {
        mesh_.triangles.push_back({polygon_[0], polygon_[i - 1], polygon_[i]});
        face_color_of_.push_back(full ? face_colors_.count() - 1 : no_value);
    }
    return Ok{};
}

void OffReader::carry()
{
    auto& attributes = mesh_.appearance.attributes;
    if (has_normals_) attributes.push_back(float_attribute("normal", Domain::vertex, 3, normals_));
    if (has_colors_) attributes.push_back(colors_.attribute("color0", Domain::vertex, {}));
    if (has_uvs_) attributes.push_back(float_attribute("uv0", Domain::vertex, 2, uvs_));
    if (std::ranges::all_of(face_color_of_, [](std::uint32_t color) { return color == no_value; })) return;
    bool in_order = face_colors_.count() == face_color_of_.size();
    for (std::size_t t = 0; t < face_color_of_.size(); ++t) in_order = in_order && face_color_of_[t] == t;
    if (in_order) face_color_of_.clear();
    attributes.push_back(face_colors_.attribute("face_color", Domain::triangle, std::move(face_color_of_)));
}

void OffReader::warn() const
{
    if (polygons_ > 0)
        tell(options_,
             concat(polygons_,
                    " polygons with more than three corners were cut into triangles, as fans from their first corner"));
    if (slivers_ > 0) tell(options_, concat(slivers_, " faces with fewer than three corners are left out"));
    if (extra_ > 0)
        tell(options_,
             concat(extra_,
                    " lines of vertices have more numbers than the first word of the file says, which are left out"));
    if (mapped_ > 0) tell(options_, concat(mapped_, " faces have a number of a colour map, which is left out"));
}

Result<Animation> OffReader::read()
{
    MESHREEL_CHECK(header());
    for (std::uint32_t v = 0; v < mesh_.vertex_count; ++v) {
        if (!next_row())
            return bad_input(concat("the file ends after ", v, " of ", mesh_.vertex_count, " vertices"), "vertex_count",
                             here());
        MESHREEL_CHECK(vertex());
    }
    for (; face_ < faces_; ++face_) {
        if (!next_row())
            return bad_input(concat("the file ends after ", face_, " of ", faces_, " faces"), "face_count", here());
        MESHREEL_CHECK(face());
    }
    if (next_row()) tell(options_, "what follows the last face is left out");
    carry();
    warn();
    mesh_.times_s = {0.0};
    return std::move(mesh_);
}

} // namespace

Result<Animation> parse_off(ByteView bytes, const LoadOptions& options)
{
    return OffReader(bytes, options).read();
}

Result<Animation> load_off(const std::string& path, const LoadOptions& options)
{
    return load_sequence(path, options, {parse_off});
}
Result<std::unique_ptr<FrameSource>> open_off(const std::string& path, const LoadOptions& options)
{
    return open_sequence(path, options, {parse_off});
}

} // namespace meshreel::io
