/// Reading OBJ line by line.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <map>
#include <unordered_map>

#include "meshreel/base/file.h"
#include "meshreel/base/text.h"
#include "meshreel/io/attributes.h"
#include "meshreel/io/frames.h"
#include "meshreel/io/obj.h"
#include "meshreel/io/sequence.h"
#include "meshreel/io/text_scan.h"

namespace meshreel::io {

namespace {

/// Statements of the format that an animation has no place for, and how to call them.
struct LeftOut {
    std::string_view keyword, what;
};
constexpr std::array left_out{LeftOut{"l", "lines"},
                              LeftOut{"p", "points"},
                              LeftOut{"vp", "free-form geometry"},
                              LeftOut{"cstype", "free-form geometry"},
                              LeftOut{"deg", "free-form geometry"},
                              LeftOut{"curv", "free-form geometry"},
                              LeftOut{"curv2", "free-form geometry"},
                              LeftOut{"surf", "free-form geometry"},
                              LeftOut{"parm", "free-form geometry"},
                              LeftOut{"end", "free-form geometry"}};

/// Names in the order of their first use. No name: no number.
class NameTable {
public:
    std::uint32_t number(std::string_view name)
    {
        if (name.empty()) return no_value;
        const auto [place, added] = numbers_.try_emplace(std::string(name), static_cast<std::uint32_t>(names.size()));
        if (added) names.emplace_back(name);
        return place->second;
    }
    std::vector<std::string> names;

private:
    std::unordered_map<std::string, std::uint32_t> numbers_;
};

/// A table of vt or vn, and which of its rows each corner names.
struct CornerTable {
    std::string_view field;
    std::vector<float> values = {};
    std::size_t components = 0;
    std::size_t count = 0;
    std::vector<std::uint32_t> indices = {}; ///< [3T]
    std::uint64_t largest = 0;               ///< row named, from 1
    std::uint64_t largest_line = 0;
};

struct Corner {
    std::uint32_t vertex = 0, uv = no_value, normal = no_value;
};

class ObjReader {
public:
    ObjReader(ByteView bytes, const LoadOptions& options)
        : lines_(bytes, LineScanner::Continuation::backslash), options_(options)
    {
    }
    Result<Animation> read();

private:
    Status statement(std::string_view keyword);
    Status other_statement(std::string_view keyword);
    Status vertex();
    Status row(CornerTable& table, std::size_t fewest, std::size_t most);
    Status face();
    Status corner(std::string_view word);
    Result<std::uint32_t> index(std::string_view word, CornerTable& table);
    void add_triangle(const Corner& a, const Corner& b, const Corner& c);
    Result<std::size_t> numbers(std::string_view field);
    Status check_indices() const;
    void carry();
    void carry_corners(std::string name, CornerTable& table);
    void carry_triangles(std::string name, const std::vector<std::uint32_t>& numbers);
    void warn() const;
    Place here() const { return at_line(lines_.line()); }

    LineScanner lines_;
    const LoadOptions& options_;
    Animation mesh_;
    std::array<float, 8> row_{};
    CornerTable vertices_{.field = "v"}, uvs_{.field = "vt"}, normals_{.field = "vn"};
    std::vector<float> colors_;
    std::vector<std::uint32_t> color_of_;
    std::size_t color_components_ = 0;
    std::vector<Corner> polygon_;
    NameTable materials_, groups_;
    std::uint32_t material_ = no_value, group_ = no_value, smoothing_ = 0;
    std::vector<std::uint32_t> material_of_, group_of_, smoothing_of_;
    bool has_objects_ = false, has_groups_ = false;
    std::uint64_t polygons_ = 0, slivers_ = 0, weights_ = 0, unknown_ = 0, unknown_line_ = 0;
    std::string unknown_word_;
    std::map<std::string_view, std::uint64_t> left_out_;
};

Result<std::size_t> ObjReader::numbers(std::string_view field)
{
    std::size_t count = 0;
    for (std::string_view word = lines_.word(); !word.empty(); word = lines_.word()) {
        const auto number = to_float(word);
        if (!number) return bad_input(in_quotes(word) + " is not a number", std::string(field), here());
        if (count == row_.size()) return bad_input("too many numbers", std::string(field), here());
        row_[count++] = *number;
    }
    return count;
}

Status ObjReader::vertex()
{
    MESHREEL_TRY(const std::size_t count, numbers("v"));
    if (count < 3 || count == 5 || count > 7)
        return bad_input(concat(count, " numbers instead of 3 (position), 4 (with weight), 6 or 7 (with colour)"), "v",
                         here());
    mesh_.positions.insert(mesh_.positions.end(), row_.begin(), row_.begin() + 3);
    MESHREEL_CHECK(within(++vertices_.count, std::min<std::uint64_t>(options_.limits.max_vertices, no_value), "v"));
    if (count == 4 && row_[3] != 1.0f) ++weights_;
    const bool colored = count >= 6;
    if (colored && color_of_.empty()) color_of_.assign(vertices_.count - 1, no_value);
    if (!colored && color_of_.empty()) return Ok{};
    color_of_.push_back(colored ? static_cast<std::uint32_t>(colors_.size() / 4) : no_value);
    if (!colored) return Ok{};
    color_components_ = std::max<std::size_t>(color_components_, count - 3);
    if (count == 6) row_[6] = 1.0f;
    colors_.insert(colors_.end(), row_.begin() + 3, row_.begin() + 7);
    return Ok{};
}

Status ObjReader::row(CornerTable& table, std::size_t fewest, std::size_t most)
{
    MESHREEL_TRY(const std::size_t count, numbers(table.field));
    if (count < fewest || count > most)
        return bad_input(concat(count, " numbers instead of ", fewest, " to ", most), std::string(table.field), here());
    std::fill(row_.begin() + count, row_.begin() + 3, 0.0f);
    table.components = std::max(table.components, count);
    table.values.insert(table.values.end(), row_.begin(), row_.begin() + 3);
    ++table.count;
    return Ok{};
}

Result<std::uint32_t> ObjReader::index(std::string_view word, CornerTable& table)
{
    const auto number = to_integer(word);
    if (!number) return bad_input(in_quotes(word) + " is not an index", "f", here());
    const auto count = static_cast<std::int64_t>(table.count);
    if (*number == 0 || *number < -count)
        return bad_input(concat("index ", *number, " where ", count, " '", table.field, "' lines came before"), "f",
                         here());
    const auto from_one = static_cast<std::uint64_t>(*number > 0 ? *number : count + 1 + *number);
    if (from_one > table.largest) {
        table.largest = from_one;
        table.largest_line = lines_.line();
    }
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(from_one - 1, no_value - 1));
}

/// v, v/vt, v//vn or v/vt/vn.
Status ObjReader::corner(std::string_view word)
{
    const std::size_t first = std::min(word.find('/'), word.size());
    const std::size_t second = std::min(word.find('/', std::min(first + 1, word.size())), word.size());
    Corner corner;
    MESHREEL_TRY(corner.vertex, index(word.substr(0, first), vertices_));
    if (second > first + 1) {
        MESHREEL_TRY(corner.uv, index(word.substr(first + 1, second - first - 1), uvs_));
    }
    if (second + 1 < word.size()) {
        MESHREEL_TRY(corner.normal, index(word.substr(second + 1), normals_));
    }
    polygon_.push_back(corner);
    return Ok{};
}

void ObjReader::add_triangle(const Corner& a, const Corner& b, const Corner& c)
{
    mesh_.triangles.push_back({a.vertex, b.vertex, c.vertex});
    uvs_.indices.insert(uvs_.indices.end(), {a.uv, b.uv, c.uv});
    normals_.indices.insert(normals_.indices.end(), {a.normal, b.normal, c.normal});
    material_of_.push_back(material_);
    group_of_.push_back(group_);
    smoothing_of_.push_back(smoothing_);
}

Status ObjReader::face()
{
    polygon_.clear();
    for (std::string_view word = lines_.word(); !word.empty(); word = lines_.word()) MESHREEL_CHECK(corner(word));
    if (polygon_.size() < 3) ++slivers_;
    if (polygon_.size() > 3) ++polygons_;
    MESHREEL_CHECK(within(mesh_.triangles.size() + polygon_.size(), options_.limits.max_triangles, "f"));
    for (std::size_t i = 2; i < polygon_.size(); ++i) add_triangle(polygon_[0], polygon_[i - 1], polygon_[i]);
    return Ok{};
}

Status ObjReader::statement(std::string_view keyword)
{
    if (keyword == "v") return vertex();
    if (keyword == "f" || keyword == "fo") return face();
    if (keyword == "vt") return row(uvs_, 1, 3);
    if (keyword == "vn") return row(normals_, 3, 3);
    return other_statement(keyword);
}

Status ObjReader::other_statement(std::string_view keyword)
{
    const auto known = std::ranges::find(left_out, keyword, &LeftOut::keyword);
    if (keyword == "usemtl") {
        material_ = materials_.number(lines_.rest());
    } else if (keyword == "g" || keyword == "o") {
        group_ = groups_.number(lines_.rest());
        (keyword == "g" ? has_groups_ : has_objects_) = true;
    } else if (keyword == "s") {
        const std::string_view word = lines_.word();
        const auto number = to_integer(word);
        if (word != "off" && (!number || *number < 0 || *number >= no_value))
            return bad_input(in_quotes(word) + " is not a smoothing group", "s", here());
        smoothing_ = number ? static_cast<std::uint32_t>(*number) : 0;
    } else if (keyword == "mtllib") {
        mesh_.appearance.assets.push_back({std::string(lines_.rest()), "model/mtl", {}});
    } else if (known != left_out.end()) {
        ++left_out_[known->what];
    } else if (std::ranges::any_of(keyword, [](char c) { return static_cast<unsigned char>(c) < ' '; })) {
        return bad_input(in_quotes(keyword) + " is no statement of an OBJ file", {}, here());
    } else if (unknown_++ == 0) {
        unknown_line_ = lines_.line();
        unknown_word_ = in_quotes(keyword);
    }
    return Ok{};
}

Status ObjReader::check_indices() const
{
    for (const CornerTable* table : {&vertices_, &uvs_, &normals_})
        if (table->largest > table->count)
            return bad_input(
                concat("index ", table->largest, " is beyond the ", table->count, " '", table->field, "' lines"), "f",
                at_line(table->largest_line));
    return Ok{};
}

void ObjReader::carry_corners(std::string name, CornerTable& table)
{
    if (table.count == 0) return;
    if (mesh_.triangles.empty()) return tell(options_, concat("the '", table.field, "' lines belong to no face"));
    const std::size_t components = std::max<std::size_t>(table.components, 2);
    if (components == 2) // rows were stored three numbers wide
        for (std::size_t i = 0; i < table.count; ++i)
            std::copy_n(table.values.begin() + i * 3, 2, table.values.begin() + i * 2);
    table.values.resize(table.count * components);
    mesh_.appearance.attributes.push_back(
        indexed(float_attribute(std::move(name), Domain::corner, static_cast<std::uint8_t>(components), table.values),
                std::move(table.indices)));
}

void ObjReader::carry_triangles(std::string name, const std::vector<std::uint32_t>& numbers)
{
    const bool any = std::ranges::any_of(numbers, [](std::uint32_t number) { return number != no_value; });
    if (any) mesh_.appearance.attributes.push_back(triangle_numbers(std::move(name), numbers));
}

void ObjReader::carry()
{
    carry_corners("uv0", uvs_);
    carry_corners("normal", normals_);
    if (!color_of_.empty()) {
        if (color_components_ == 3)
            for (std::size_t i = 0; i * 4 < colors_.size(); ++i)
                std::copy_n(colors_.begin() + i * 4, 3, colors_.begin() + i * 3);
        colors_.resize(colors_.size() / 4 * color_components_);
        if (std::ranges::find(color_of_, no_value) == color_of_.end()) color_of_.clear();
        mesh_.appearance.attributes.push_back(
            indexed(float_attribute("color0", Domain::vertex, static_cast<std::uint8_t>(color_components_), colors_),
                    std::move(color_of_)));
    }
    if (!materials_.names.empty()) carry_triangles("material", material_of_);
    if (!groups_.names.empty()) carry_triangles("group", group_of_);
    if (std::ranges::any_of(smoothing_of_, [](std::uint32_t number) { return number != 0; }))
        carry_triangles("smoothing", smoothing_of_);
    mesh_.appearance.materials = std::move(materials_.names);
    mesh_.appearance.groups = std::move(groups_.names);
}

void ObjReader::warn() const
{
    if (polygons_ > 0)
        tell(options_,
             concat(polygons_,
                    " polygons with more than three corners were cut into triangles, as fans from their first corner"));
    if (slivers_ > 0) tell(options_, concat(slivers_, " faces with fewer than three corners are left out"));
    if (weights_ > 0) tell(options_, concat(weights_, " vertices have a weight, which is left out"));
    if (has_groups_ && has_objects_)
        tell(options_, "there are both 'o' and 'g' lines: a triangle's group is the nearest before it of either");
    for (const auto& [what, count] : left_out_) tell(options_, concat(what, " are left out (", count, " statements)"));
    if (unknown_ > 0)
        tell(options_, concat(unknown_, " statements are unknown and left out, the first ", unknown_word_, " in line ",
                              unknown_line_));
}

Result<Animation> ObjReader::read()
{
    while (lines_.next_line()) {
        const std::string_view keyword = lines_.word();
        if (!keyword.empty()) MESHREEL_CHECK(statement(keyword));
    }
    if (vertices_.count == 0) return bad_input("there is no vertex; is this an OBJ file?", "v");
    MESHREEL_CHECK(check_indices());
    mesh_.vertex_count = static_cast<std::uint32_t>(vertices_.count);
    mesh_.times_s = {0.0};
    carry();
    warn();
    return std::move(mesh_);
}

/// Only a file below the mesh's own folder is read: a mesh must not make us carry any file of the machine away.
bool is_local(const std::string& name)
{
    return !name.empty() && name.front() != '/' && ("/" + name + "/").find("/../") == std::string::npos;
}

void read_libraries(Animation& animation, const std::string& path, const LoadOptions& options)
{
    const std::string folder = path.substr(0, path.rfind('/') + 1);
    for (Asset& asset : animation.appearance.assets) {
        auto bytes = is_local(asset.name) ? read_file(folder + asset.name, options.limits)
                                          : Result<Bytes>(bad_input("it is not in the mesh's folder"));
        if (bytes.ok())
            asset.bytes = *std::move(bytes);
        else
            tell(options, concat(path, ": the material library ", asset.name,
                                 " is carried by name only: ", bytes.error().message));
    }
}

} // namespace

Result<Animation> parse_obj(ByteView bytes, const LoadOptions& options)
{
    return ObjReader(bytes, options).read();
}

Result<Animation> load_obj(const std::string& path, const LoadOptions& options)
{
    return load_sequence(path, options, {parse_obj, read_libraries});
}
Result<std::unique_ptr<FrameSource>> open_obj(const std::string& path, const LoadOptions& options)
{
    return open_sequence(path, options, {parse_obj, read_libraries});
}

} // namespace meshreel::io
