// SPDX-License-Identifier: Apache-2.0
#include "catalog/sqlite/encoding.h"

#include <zlib.h>

#include <bit>
#include <cstring>
#include <type_traits>

#include "catalog/shape_catalog.h"

namespace catalog::sqlite {
namespace {

static_assert(std::endian::native == std::endian::little, "blobs are copied as they lie in memory");

class Writer {
 public:
  template <class Value>
  void put(const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    const auto* first = reinterpret_cast<const unsigned char*>(&value);
    bytes_.insert(bytes_.end(), first, first + sizeof value);
  }
  void put_count(std::size_t count) { put(static_cast<std::int32_t>(count)); }
  Bytes take() { return std::move(bytes_); }

 private:
  Bytes bytes_;
};

class Reader {
 public:
  explicit Reader(const Bytes& bytes) : bytes_(bytes) {}

  template <class Value>
  Value get() {
    Value value;
    if (left() < sizeof value) throw DamagedBlob("it ends early");
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  // A count of things that take at least `size_of_each` bytes.
  std::size_t get_count(std::size_t size_of_each) {
    const auto count = get<std::int32_t>();
    if (count < 0 || static_cast<std::size_t>(count) > left() / size_of_each) throw DamagedBlob("a count is too large");
    return static_cast<std::size_t>(count);
  }
  int get_index(std::size_t end) {
    const auto index = get<std::int32_t>();
    if (index < 0 || static_cast<std::size_t>(index) >= end) throw DamagedBlob("a vertex index is out of range");
    return index;
  }
  std::size_t left() const { return bytes_.size() - at_; }
  void expect_end() const {
    if (left() != 0) throw DamagedBlob("it is longer than its counts say");
  }

 private:
  const Bytes& bytes_;
  std::size_t at_ = 0;
};

constexpr std::size_t kSmallestFace = 2 * sizeof(std::int32_t) + 4 * sizeof(double);  // a face without corners [bytes]

}  // namespace

Bytes encode_vertices(const std::vector<Point>& vertices) {
  Writer writer;
  for (const Point& vertex : vertices) writer.put(vertex);
  return writer.take();
}

Bytes encode_faces(const std::vector<Triangle>& faces) {
  Writer writer;
  for (const Triangle& face : faces)
    for (const int index : face) writer.put(static_cast<std::int32_t>(index));
  return writer.take();
}

TriangleMesh decode_mesh(const Bytes& vertices, const Bytes& faces) {
  TriangleMesh mesh;
  mesh.vertices.reserve(vertices.size() / sizeof(Point));
  mesh.faces.reserve(faces.size() / sizeof(Triangle));
  for (Reader reader(vertices); reader.left() > 0;) mesh.vertices.push_back(reader.get<Point>());
  for (Reader reader(faces); reader.left() > 0;) {
    Triangle& face = mesh.faces.emplace_back();
    for (int& index : face) index = reader.get_index(mesh.vertex_count());
  }
  return mesh;
}

Bytes encode_part(const ConvexPart& part) {
  Writer writer;
  writer.put_count(part.vertex_count());
  writer.put_count(part.face_count());
  for (const Point& vertex : part.vertices) writer.put(vertex);
  for (const ConvexFace& face : part.faces) {
    writer.put_count(face.kind == FaceKind::inner ? 1 : 0);
    writer.put_count(face.vertices.size());
    writer.put(face.plane.normal);
    writer.put(face.plane.offset);
    for (const int index : face.vertices) writer.put(static_cast<std::int32_t>(index));
  }
  return writer.take();
}

ConvexPart decode_part(const Bytes& bytes) {
  Reader reader(bytes);
  ConvexPart part;
  const std::size_t vertex_count = reader.get_count(sizeof(Point));
  const std::size_t face_count = reader.get_count(kSmallestFace);
  for (std::size_t v = 0; v < vertex_count; ++v) part.vertices.push_back(reader.get<Point>());
  for (std::size_t f = 0; f < face_count; ++f) {
    ConvexFace& face = part.faces.emplace_back();
    const auto kind = reader.get<std::int32_t>();
    if (kind != 0 && kind != 1) throw DamagedBlob("a face is neither outer nor inner");
    face.kind = kind == 1 ? FaceKind::inner : FaceKind::outer;
    const std::size_t corner_count = reader.get_count(sizeof(std::int32_t));
    face.plane.normal = reader.get<Point>();
    face.plane.offset = reader.get<double>();
    for (std::size_t corner = 0; corner < corner_count; ++corner)
      face.vertices.push_back(reader.get_index(vertex_count));
  }
  reader.expect_end();
  return part;
}

Bytes encode_mass_properties(const MassProperties& properties) {
  Writer writer;
  writer.put(properties.volume);
  writer.put(properties.centroid);
  writer.put(properties.principal_inertia);
  writer.put(properties.principal_axes);
  return writer.take();
}

MassProperties decode_mass_properties(const Bytes& bytes) {
  Reader reader(bytes);
  MassProperties properties;
  properties.volume = reader.get<double>();
  properties.centroid = reader.get<Point>();
  properties.principal_inertia = reader.get<Point>();
  properties.principal_axes = reader.get<Matrix3>();
  reader.expect_end();
  return properties;
}

Bytes encode_source_frame(const SourceFrame& frame) {
  Writer writer;
  writer.put(frame.axes);
  writer.put(frame.origin);
  writer.put(frame.scale);
  return writer.take();
}

SourceFrame decode_source_frame(const Bytes& bytes) {
  Reader reader(bytes);
  SourceFrame frame;
  frame.axes = reader.get<Matrix3>();
  frame.origin = reader.get<Point>();
  frame.scale = reader.get<double>();
  reader.expect_end();
  return frame;
}

Bytes compressed(const Bytes& bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  Bytes stream(size);
  if (compress2(stream.data(), &size, bytes.data(), static_cast<uLong>(bytes.size()), 6) != Z_OK)
    throw std::runtime_error("zlib cannot compress a blob of " + std::to_string(bytes.size()) + " bytes");
  stream.resize(size);
  return stream;
}

Bytes decompressed(const Bytes& stream) {
  z_stream inflater{};
  inflater.next_in = const_cast<unsigned char*>(stream.data());
  inflater.avail_in = static_cast<uInt>(stream.size());
  if (inflateInit(&inflater) != Z_OK) throw std::runtime_error("zlib cannot start");
  Bytes bytes;
  int result = Z_OK;
  while (result == Z_OK) {
    unsigned char chunk[1 << 16];
    inflater.next_out = chunk;
    inflater.avail_out = sizeof chunk;
    result = inflate(&inflater, Z_NO_FLUSH);
    bytes.insert(bytes.end(), chunk, inflater.next_out);
  }
  inflateEnd(&inflater);
  if (result != Z_STREAM_END) throw DamagedBlob("its zlib stream is broken");
  return bytes;
}

std::string sha256_of(const Bytes& first, const Bytes& second) {
  Bytes both = first;
  both.insert(both.end(), second.begin(), second.end());
  return sha256(both.data(), both.size());
}

}  // namespace catalog::sqlite
