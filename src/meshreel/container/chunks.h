/// The chunks that all codecs share: what the file holds, when its frames are, what it is called, which frames a segment has.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "meshreel/base/order.h"
#include "meshreel/container/fields.h"
#include "meshreel/container/words.h"
#include "meshreel/mesh/animation.h"

namespace meshreel::container {

/// HEAD: what the file holds. All other chunks rest on its counts.
struct Header {
    std::string codec;                    ///< a row of the codec registry
    std::uint32_t vertex_count = 0;       ///< V
    std::uint32_t coded_vertex_count = 0; ///< W, after welding
    std::uint32_t triangle_count = 0;     ///< T
    std::uint32_t frame_count = 0;        ///< F
    Order order = Order::keep;
    std::uint64_t base_fingerprint = 0; ///< fingerprint_of the base mesh
    std::string encoder;                ///< who wrote the file; for people

    void fields(auto& io)
    {
        io.text("codec", codec, 32, "name of the codec that wrote SEGM");
        io.varint("vertex_count", vertex_count, up_to(Limit::vertices, 1), "V");
        io.varint("coded_vertex_count", coded_vertex_count, up_to(Limit::vertices, 1),
                  "W: vertices that the codec sees, 1 .. V");
        io.varint("triangle_count", triangle_count, up_to(Limit::triangles), "T");
        io.varint("frame_count", frame_count, up_to(Limit::frames, 1), "F");
        io.choice("order", order, {"keep", "free", "base"},
                  "of vertices and triangles: the original one; the codec's; that of a base mesh the reader must have");
        io.when(order == Order::base, "order = base", [&] {
            io.u64("base_fingerprint", base_fingerprint, any,
                   "XXH3-64 of the base mesh's V and then its triangles, all u32");
        });
        io.text("encoder", encoder, 256, "program and version that wrote the file; means nothing");
        io.must(coded_vertex_count <= vertex_count, "coded_vertex_count", "W <= V");
    }
};

/// TIME: when the frames are, in seconds; the very doubles that the animation had.
struct TimeChunk {
    enum class Mode : std::uint8_t { uniform, corrected } mode = Mode::uniform;
    double start_s = 0.0;
    double fps = 1.0;
    Squeezed corrections;

    void fields(auto& io)
    {
        io.choice("mode", mode, {"uniform", "corrected"},
                  "frame f is at start + f / fps, all in f64; or at that, corrected");
        io.f64("start_s", start_s, finite, "seconds");
        io.f64("fps", fps, positive, "frames a second");
        io.when(mode == Mode::corrected, "mode = corrected", [&] { io.part("corrections", corrections); });
    }
};

/// meta: what is known of the animation as a whole.
struct MetaChunk {
    Metadata meta;

    void fields(auto& io)
    {
        io.text("name", meta.name, 65535, "of the animation; may be empty");
        io.flag("loop", meta.loop, "the last frame is followed by the first");
        io.choice("up", meta.up, {"unknown", "x", "y", "z"}, "axis that points up");
        io.f64("metres_per_unit", meta.metres_per_unit, not_negative, "0: unknown");
        io.f64("fps", meta.fps, not_negative, "nominal frames a second; 0: unknown");
    }
};

/// attr: one table of values beside the positions.
struct AttributeChunk {
    Attribute head; ///< its values and indices stay empty
    std::uint64_t value_count = 0;
    bool repeated = false;
    std::uint64_t distinct_count = 0;
    WordTable places;
    WordTable values;
    bool indexed = false;
    WordTable indices;

    void fields(auto& io)
    {
        io.text("name", head.name, 65535, "uv0, normal, color0, material, ...; any name");
        io.choice("domain", head.domain, {"vertex", "corner", "triangle"},
                  "what an element is: V vertices, 3T corners or T triangles");
        io.choice("type", head.type, {"f32", "u8", "u16", "u32", "i8", "i16"}, "of a component");
        io.u8("components", head.components, {1, 16}, "of a value");
        io.flag("normalized", head.normalized, "integers stand for [0, 1] or [-1, 1]");
        io.varint("value_count", value_count, up_to(Limit::memory),
                  "values in the table; as many as elements if not indexed");
        io.flag("repeated", repeated, "each different value is stored once, and places says which is where");
        io.when(repeated, "repeated", [&] {
            io.varint("distinct_count", distinct_count, up_to(Limit::memory), "values stored");
            io.part("places", places);
        });
        io.part("values", values);
        io.flag("indexed", indexed, "elements name their value by an index; else element i has value i");
        io.when(indexed, "indexed", [&] { io.part("indices", indices); });
    }
};

/// matl and grup: names, which attributes "material" and "group" index.
struct NamesChunk {
    std::vector<std::string> names;

    void fields(auto& io) { io.texts("names", names, 65535, "a name"); }
};

/// aset: a file that travels along unread.
struct AssetChunk {
    std::string name, mime_type;
    Squeezed bytes;

    void fields(auto& io)
    {
        io.text("name", name, 65535, "of the file");
        io.text("mime_type", mime_type, 255, "image/png, ...");
        io.part("bytes", bytes);
    }
};

/// SEGM: a run of frames; v1 decoders put the runs one after the other.
struct Segment {
    std::uint32_t first_frame = 0;
    std::uint32_t frame_count = 0;
    ByteView payload;                 ///< the codec's own; must outlive this struct
    std::uint64_t payload_offset = 0; ///< of its first byte in the file; known after read_segment()

    void fields(auto& io)
    {
        io.varint("first_frame", first_frame, any, "the sum of the frame counts before it");
        io.varint("frame_count", frame_count, {1}, "frames of this segment");
        io.rest("payload", payload, "the codec's, see its own tables");
    }

    /// The payload, for a codec to read.
    Source source() const { return {payload, payload_offset, "SEGM"}; }
};

/// What a mesh is to a file of Order::base: XXH3-64 of V and the triangles, each number as u32. @cost O(T)
std::uint64_t fingerprint_of(std::uint32_t vertex_count, const std::vector<Triangle>& triangles);

/// TIME from times that increase strictly; and back. @fails bad_input: not F increasing finite times.
TimeChunk pack_times(const std::vector<double>& times_s, double nominal_fps);
Result<std::vector<double>> unpack_times(const TimeChunk& chunk, std::uint32_t frame_count, Budget& budget);

} // namespace meshreel::container
