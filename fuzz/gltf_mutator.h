/// Changes a glTF file behind its grammar: values, members, elements and bytes of the buffer; lengths of chunks then hold.
// SPDX-License-Identifier: MIT
//
// Included once by a target; libFuzzer finds the last two functions by their names. What is no glTF yet is mutated as bytes.
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace meshreel::fuzz {

using nlohmann::json;
using Text = std::string; // of bytes

struct Glb {
    json root;
    Text binary;
};

inline std::uint32_t word_at(const Text& file, std::size_t at)
{
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < 4 && at + i < file.size(); ++i)
        word |= static_cast<std::uint32_t>(static_cast<std::uint8_t>(file[at + i])) << 8 * i;
    return word;
}

inline void put_word(Text& file, std::size_t word)
{
    for (int shift = 0; shift < 32; shift += 8) file += static_cast<char>(word >> shift);
}

/// Of a GLB, or of JSON alone; nothing where it is neither, or nested deeper than stacks are.
inline std::optional<Glb> taken_apart(const Text& file)
{
    constexpr int most_nested = 64;
    constexpr std::size_t text_begins = 20, chunk_header = 8;
    const bool glb = file.compare(0, 4, "glTF") == 0 && file.size() >= text_begins;
    const Text text = glb ? file.substr(text_begins, word_at(file, 12)) : file;
    bool flat = true;
    const auto watch = [&](int depth, json::parse_event_t, json&) { return flat = flat && depth < most_nested; };
    Glb parts{json::parse(text, watch, false), {}};
    if (!flat || !parts.root.is_object()) return {};
    const std::size_t binary_begins = text_begins + text.size() + chunk_header;
    if (glb && binary_begins < file.size()) parts.binary = file.substr(binary_begins);
    return parts;
}

/// @return the size; 0: it has no room.
inline std::size_t put_together(const Glb& parts, std::uint8_t* data, std::size_t max_size)
{
    Text text = parts.root.dump(-1, ' ', false, json::error_handler_t::replace), file = "glTF";
    text.resize((text.size() + 3) / 4 * 4, ' ');
    for (const std::size_t word : {std::size_t{2}, 28 + text.size() + parts.binary.size(), text.size()})
        put_word(file, word);
    file += "JSON" + text;
    put_word(file, parts.binary.size());
    file += Text("BIN\0", 4) + parts.binary;
    if (file.size() > max_size) return 0;
    std::copy(file.begin(), file.end(), data);
    return file.size();
}

inline void mutate_bytes(Text& bytes)
{
    constexpr std::size_t growth = 16;
    const std::size_t size = bytes.size();
    bytes.resize(size + growth);
    bytes.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(bytes.data()), size, bytes.size()));
}

/// Draws values, members and elements of a document.
class Draw {
public:
    explicit Draw(unsigned seed) : random_(seed) {}

    std::size_t below(std::size_t count) { return random_() % count; }

    json& value(json& root)
    {
        return *one_of(root, [](const json&) { return true; });
    }

    json& container(json& root)
    {
        return *one_of(root, [](const json& value) { return value.is_structured(); });
    }

    /// A value of the same type as the given one: itself where there is no other.
    json& like(const json& wanted, json& root)
    {
        json* found = one_of(root, [&](const json& value) { return value.type() == wanted.type(); });
        return found != nullptr ? *found : root;
    }

    json::iterator child(json& container)
    {
        return std::next(container.begin(), static_cast<std::ptrdiff_t>(below(container.size())));
    }

private:
    template <class Wanted>
    json* one_of(json& root, const Wanted& wanted)
    {
        std::vector<json*> found;
        gather(root, wanted, found);
        return found.empty() ? nullptr : found[below(found.size())];
    }

    template <class Wanted>
    static void gather(json& value, const Wanted& wanted, std::vector<json*>& found)
    {
        if (wanted(value)) found.push_back(&value);
        if (!value.is_structured()) return;
        for (json& item : value) gather(item, wanted, found);
    }

    std::minstd_rand random_;
};

/// Numbers that mean something in glTF, and numbers that should not.
inline const json& telling_numbers()
{
    static const json numbers = {0,     1,     2,     3,     4,          5,     6,      7,      8,    12,
                                 16,    255,   5120,  5121,  5122,       5123,  5125,   5126,   -1,   0.5,
                                 -0.25, 65535, 65536, 1e-40, 4294967295, 1e300, 0x1p31, 0x1p53, 1e18, 33071};
    return numbers;
}

inline void mutate_scalar(json& value, Draw& draw)
{
    if (value.is_string()) {
        Text text = value.get<Text>();
        mutate_bytes(text);
        value = text;
    } else if (value.is_number_integer() && draw.below(2) == 0) {
        value = static_cast<std::int64_t>(value.get<std::uint64_t>() + (draw.below(2) == 0 ? 1 : ~std::uint64_t{0}));
    } else {
        value = telling_numbers()[draw.below(telling_numbers().size())];
    }
}

/// A child removed, doubled, or put in the place of another.
inline void mutate_children(json& container, Draw& draw)
{
    if (container.empty()) return;
    const json::iterator one = draw.child(container), other = draw.child(container);
    switch (draw.below(3)) {
    case 0:
        container.erase(one);
        break;
    case 1:
        if (container.is_array()) container.push_back(json(*one));
        break;
    default:
        std::swap(*one, *other);
    }
}

inline void mutate(Glb& glb, Draw& draw)
{
    switch (draw.below(8)) {
    case 0:
    case 1:
        mutate_bytes(glb.binary);
        break;
    case 2:
    case 3:
        mutate_children(draw.container(glb.root), draw);
        break;
    case 4:
    case 5: {
        json& value = draw.value(glb.root);
        value = json(draw.like(value, glb.root));
        break;
    }
    default:
        if (json& value = draw.value(glb.root); !value.is_structured()) mutate_scalar(value, draw);
    }
}

/// A member or element of the other document comes into one of this.
inline void cross(Glb& glb, Glb& other, Draw& draw)
{
    json& source = draw.container(other.root);
    json& target = draw.like(source, glb.root);
    if (source.empty() || source.type() != target.type()) return;
    const json::iterator taken = draw.child(source);
    if (source.is_object()) target[taken.key()] = *taken;
    if (source.is_array()) target.push_back(*taken);
    if (draw.below(4) == 0) glb.binary = other.binary;
}

inline Text text_of(const std::uint8_t* data, std::size_t size)
{
    return size == 0 ? Text() : Text(reinterpret_cast<const char*>(data), size);
}

} // namespace meshreel::fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed)
{
    using namespace meshreel::fuzz;
    Draw draw(seed);
    auto glb = taken_apart(text_of(data, size));
    if (!glb || draw.below(64) == 0) return LLVMFuzzerMutate(data, size, max_size);
    mutate(*glb, draw);
    const std::size_t changed = put_together(*glb, data, max_size);
    return changed != 0 ? changed : size;
}

extern "C" std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* data1, std::size_t size1,
                                                 const std::uint8_t* data2, std::size_t size2, std::uint8_t* out,
                                                 std::size_t max_size, unsigned seed)
{
    using namespace meshreel::fuzz;
    Draw draw(seed);
    auto glb = taken_apart(text_of(data1, size1)), other = taken_apart(text_of(data2, size2));
    if (!glb || !other) return 0;
    cross(*glb, *other, draw);
    return put_together(*glb, out, max_size);
}
