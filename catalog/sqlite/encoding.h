// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "catalog/convex_part.h"
#include "catalog/mass_properties.h"
#include "catalog/shape_record.h"
#include "catalog/sqlite/statement.h"
#include "catalog/triangle_mesh.h"

namespace catalog::sqlite {

// Byte forms of geometry: little-endian, every double bit for bit. The layouts are written down in
// catalog/migrations. Decoders throw DamagedBlob where bytes do not make sense.

struct DamagedBlob : std::runtime_error {
  using std::runtime_error::runtime_error;
};

Bytes encode_vertices(const std::vector<Point>& vertices);
Bytes encode_faces(const std::vector<Triangle>& faces);
TriangleMesh decode_mesh(const Bytes& vertices, const Bytes& faces);

Bytes encode_part(const ConvexPart& part);
ConvexPart decode_part(const Bytes& bytes);

Bytes encode_mass_properties(const MassProperties& properties);
MassProperties decode_mass_properties(const Bytes& bytes);

Bytes encode_source_frame(const SourceFrame& frame);
SourceFrame decode_source_frame(const Bytes& bytes);

/// zlib stream, level 6.
Bytes compressed(const Bytes& bytes);
Bytes decompressed(const Bytes& stream);

std::string sha256_of(const Bytes& first, const Bytes& second = {});

}  // namespace catalog::sqlite
