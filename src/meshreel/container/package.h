/// The parts of an animation that no codec changes, into a file and out of it.
// SPDX-License-Identifier: MIT
//
// Writing:  StreamWriter file(spool);
//           add_head(file, header, times_s, meta);      HEAD TIME meta
//           file.add(type::conn, connectivity);         CONN
//           add_appearance(file, appearance, mesh);     matl grup attr... aset...
//           file.add(type::segm, Segment{0, F, bits});  SEGM...
//           file.finish();
// Reading:  StreamReader::open, read_header, then what is wanted, one Budget for all of it.
#pragma once

#include "meshreel/container/chunks.h"
#include "meshreel/container/stream.h"

namespace meshreel::container {

/// The mesh that attributes belong to, in the order of the decoded file.
struct MeshShape {
    std::uint32_t vertex_count = 0;
    const std::vector<Triangle>& triangles;
};

/// Adds HEAD, TIME and meta. @fails usage: a count, the codec's name or a text outside its range.
Status add_head(StreamWriter& file, const Header& header, const std::vector<double>& times_s, const Metadata& meta);
/// Adds matl, grup, attr and aset, where there is anything to say. The attributes must fit the mesh (validate()).
/// @fails usage: a name too long.
Status add_appearance(StreamWriter& file, const Appearance& appearance, const MeshShape& mesh);

/// HEAD; its counts are within the limits, and so is one frame.
Result<Header> read_header(const StreamReader& file);
/// The F times; strictly increasing.
Result<std::vector<double>> read_times(const StreamReader& file, const Header& header, Budget& budget);
/// What meta says; nothing known where there is no such chunk.
Result<Metadata> read_metadata(const StreamReader& file);
/// All attributes (bit for bit as they were), names and assets.
Result<Appearance> read_appearance(const StreamReader& file, const MeshShape& mesh, Budget& budget);
/// One segment; where its payload is in the file too.
Result<Segment> read_segment(const Chunk& chunk, const DecodeLimits& limits);
/// All segments in time order; they cover 0 .. F-1.
Result<std::vector<Segment>> read_segments(const StreamReader& file, const Header& header);

/// One attribute. Packing needs a table that fits the mesh.
AttributeChunk pack_attribute(const Attribute& attribute, const MeshShape& mesh);
Result<Attribute> unpack_attribute(const AttributeChunk& chunk, const MeshShape& mesh, Budget& budget);

} // namespace meshreel::container
