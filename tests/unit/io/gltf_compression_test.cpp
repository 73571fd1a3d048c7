// SPDX-License-Identifier: MIT
#include <array>
#include <cstring>
#include <string>
#include <vector>

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include "vantage/io/model.h"
#include "vantage/mesh/measures.h"

#include "io/byte_cursor.h"
#include "io/draco_mesh.h"
#include "unit/io/error_text.h"
#include "unit/io/glb_bytes.h"

namespace vantage::test {
namespace {

using testing::HasSubstr;

using Point = std::array<float, 3>;

const std::vector<Point> kCorners = {
    {0.F, 0.F, 0.F}, {2.F, 0.F, 0.F}, {0.F, 2.F, 0.F}, {0.F, 0.F, 2.F}};
const std::vector<std::uint32_t> kFaces = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};

std::string text(const std::vector<unsigned char>& bytes) {
  return {bytes.begin(), bytes.end()};
}

/// Four corners, packed as a vertex buffer of 12 bytes a vertex.
std::string packed_corners() {
  std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(kCorners.size(), sizeof(Point)));
  bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), kCorners.data(),
                                          kCorners.size(), sizeof(Point)));
  return text(bytes);
}

std::string packed_faces() {
  std::vector<unsigned char> bytes(meshopt_encodeIndexBufferBound(kFaces.size(), kCorners.size()));
  bytes.resize(meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), kFaces.data(), kFaces.size()));
  return text(bytes);
}

/// A tetrahedron whose buffer views are packed by EXT_meshopt_compression.
struct MeshoptScene {
  std::string corners = packed_corners();
  std::string faces = packed_faces();
  std::string corner_packing = R"("byteStride":12,"count":4,"mode":"ATTRIBUTES")";
  std::string face_packing = R"("byteStride":4,"count":12,"mode":"TRIANGLES")";
  std::string corner_view{};  ///< Further members of the first view, each with a comma in front.
  std::string component_type = "5126";
  std::string node = R"("mesh":0)";

  [[nodiscard]] std::string bytes() const {
    const auto view = [](std::size_t offset, std::size_t length, const std::string& packing,
                         std::size_t unpacked, const std::string& more) {
      return R"({"buffer":1,"byteLength":)" + std::to_string(unpacked) + more +
             R"(,"extensions":{"EXT_meshopt_compression":{"buffer":0,"byteOffset":)" +
             std::to_string(offset) + R"(,"byteLength":)" + std::to_string(length) + "," + packing +
             "}}}";
    };
    return glb(R"({"asset":{"version":"2.0"},"extensionsRequired":["EXT_meshopt_compression"],)"
               R"("nodes":[{)" +
                   node +
                   R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},)"
                   R"("indices":1}]}],"accessors":[{"bufferView":0,"componentType":)" +
                   component_type +
                   R"(,"count":4,"type":"VEC3"},)"
                   R"({"bufferView":1,"componentType":5125,"count":12,"type":"SCALAR"}],)"
                   R"("bufferViews":[)" +
                   view(0, corners.size(), corner_packing, 48, corner_view) + "," +
                   view(corners.size(), faces.size(), face_packing, 48, "") +
                   R"(],"buffers":[{"byteLength":)" +
                   std::to_string(corners.size() + faces.size()) +
                   R"(},{"byteLength":96,"extensions":{"EXT_meshopt_compression":)"
                   R"({"fallback":true}}}]})",
               corners + faces);
  }

  [[nodiscard]] Model parsed() const { return parse_model(bytes(), "a.glb"); }

  [[nodiscard]] std::string error() const { return error_text(bytes(), "a.glb"); }
};

TEST(GltfMeshopt, UnpacksVerticesInTheirOrderAndTheirFaces) {
  const Model model = MeshoptScene().parsed();
  ASSERT_EQ(model.mesh.positions.size(), 4U);
  EXPECT_EQ(model.mesh.positions[1], Vec3(2.0, 0.0, 0.0));
  EXPECT_EQ(model.mesh.positions[3], Vec3(0.0, 0.0, 2.0));
  EXPECT_EQ(model.mesh.triangles.size(), 4U);
  EXPECT_DOUBLE_EQ(6.0 * signed_volume(model.mesh),
                   8.0);  // half the product of three edges of 2, times 2
}

TEST(GltfMeshopt, UnpacksAFaceListThatIsPackedAsASequence) {
  MeshoptScene scene;
  std::vector<unsigned char> bytes(
      meshopt_encodeIndexSequenceBound(kFaces.size(), kCorners.size()));
  bytes.resize(
      meshopt_encodeIndexSequence(bytes.data(), bytes.size(), kFaces.data(), kFaces.size()));
  scene.faces = text(bytes);
  scene.face_packing = R"("byteStride":4,"count":12,"mode":"INDICES")";
  EXPECT_DOUBLE_EQ(6.0 * signed_volume(scene.parsed().mesh), 8.0);
}

TEST(GltfMeshopt, UndoesTheExponentialFilter) {
  MeshoptScene scene;
  std::vector<unsigned> encoded(kCorners.size() * 3);
  meshopt_encodeFilterExp(encoded.data(), kCorners.size(), sizeof(Point), 15, &kCorners[0][0]);
  std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(kCorners.size(), sizeof(Point)));
  bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), encoded.data(),
                                          kCorners.size(), sizeof(Point)));
  scene.corners = text(bytes);
  scene.corner_packing += R"(,"filter":"EXPONENTIAL")";
  EXPECT_DOUBLE_EQ(6.0 * signed_volume(scene.parsed().mesh), 8.0);  // 2 is 1 × 2¹, exactly
}

TEST(GltfMeshopt, ScalesQuantisedPositionsByTheNode) {
  MeshoptScene scene;
  const std::vector<std::array<std::int16_t, 4>> corners = {
      {0, 0, 0, 0}, {200, 0, 0, 0}, {0, 200, 0, 0}, {0, 0, 200, 0}};
  std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(4, 8));
  bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), corners.data(), 4, 8));
  scene.corners = text(bytes);
  scene.corner_packing = R"("byteStride":8,"count":4,"mode":"ATTRIBUTES")";
  scene.corner_view = R"(,"byteStride":8)";
  scene.component_type = "5122";  // KHR_mesh_quantization
  scene.node = R"("mesh":0,"scale":[0.01,0.01,0.01])";
  EXPECT_NEAR(6.0 * signed_volume(scene.parsed().mesh), 8.0, 1e-12);
}

TEST(GltfMeshopt, SaysWhichViewIsDamaged) {
  MeshoptScene scene;
  scene.corners[0] = 'x';
  EXPECT_THAT(scene.error(), HasSubstr("buffer view 0 is packed by EXT_meshopt_compression"));
}

TEST(GltfMeshopt, RefusesToUnpackMoreThanTheFileCanHold) {
  MeshoptScene scene;
  scene.corner_packing = R"("byteStride":256,"count":4000000000,"mode":"ATTRIBUTES")";
  EXPECT_THAT(scene.error(), HasSubstr("more than the size of the file allows"));
}

TEST(GltfMeshopt, RefusesSizesThatItsDecoderWouldTrust) {
  for (const char* packing :
       {R"("byteStride":0,"count":4,"mode":"ATTRIBUTES")",
        R"("byteStride":10,"count":4,"mode":"ATTRIBUTES")",
        R"("byteStride":260,"count":4,"mode":"ATTRIBUTES")", R"("byteStride":12,"count":4)",
        R"("byteStride":3,"count":3,"mode":"INDICES")",
        R"("byteStride":4,"count":4,"mode":"TRIANGLES")",
        R"("byteStride":12,"count":4,"mode":"ATTRIBUTES","filter":"QUATERNION")",
        R"("byteStride":12,"count":-4,"mode":"ATTRIBUTES")"}) {
    MeshoptScene scene;
    scene.corner_packing = packing;
    EXPECT_THAT(scene.error(), HasSubstr("buffer view 0")) << packing;
  }
}

TEST(GltfMeshopt, RefusesTheSuccessorByNameAndSaysWhatToDo) {
  std::string bytes = MeshoptScene().bytes();
  bytes.replace(bytes.find("EXT_meshopt_compression"), 3, "KHR");
  EXPECT_THAT(error_text(bytes, "a.glb"), HasSubstr("gltfpack -c"));
}

/// A tetrahedron as Draco packs it. \param is_held whether joint 0 holds all of it: attributes 1 and 2.
std::string draco_bytes(int method, bool is_held = false) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(4);
  const int position =
      builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  for (std::size_t f = 0; f < 4; ++f) {
    builder.SetAttributeValuesForFace(
        position, draco::FaceIndex(static_cast<std::uint32_t>(f)), kCorners[kFaces[3 * f]].data(),
        kCorners[kFaces[3 * f + 1]].data(), kCorners[kFaces[3 * f + 2]].data());
  }
  if (is_held) {
    constexpr std::array<std::uint8_t, 4> kJoints{};
    constexpr std::array<float, 4> kWeights{1.0F};
    const int joints = builder.AddAttribute(draco::GeometryAttribute::GENERIC, 4, draco::DT_UINT8);
    const int weights =
        builder.AddAttribute(draco::GeometryAttribute::GENERIC, 4, draco::DT_FLOAT32);
    for (std::uint32_t f = 0; f < 4; ++f) {
      const draco::FaceIndex face(f);
      builder.SetAttributeValuesForFace(joints, face, kJoints.data(), kJoints.data(),
                                        kJoints.data());
      builder.SetAttributeValuesForFace(weights, face, kWeights.data(), kWeights.data(),
                                        kWeights.data());
    }
  }
  const auto mesh = builder.Finalize();
  draco::Encoder encoder;
  encoder.SetEncodingMethod(method);
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 11);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
  return {buffer.data(), buffer.size()};
}

struct DracoScene {
  std::string packed = draco_bytes(draco::MESH_EDGEBREAKER_ENCODING);
  std::string id = "0";
  std::string mode = "4";

  [[nodiscard]] std::string bytes() const {
    return glb(
        R"({"asset":{"version":"2.0"},"extensionsRequired":["KHR_draco_mesh_compression"],)"
        R"("extensionsUsed":["KHR_draco_mesh_compression"],"scenes":[{"nodes":[0]}],)"
        R"("nodes":[{"mesh":0,"translation":[0,0,10]}],"meshes":[{"primitives":[{"mode":)" +
            mode +
            R"(,"attributes":{"POSITION":0},"indices":1,"extensions":{"KHR_draco_mesh_compression":)"
            R"({"bufferView":0,"attributes":{"POSITION":)" +
            id +
            R"(}}}}]}],"accessors":[{"componentType":5126,"count":4,"type":"VEC3"},)"
            R"({"componentType":5125,"count":12,"type":"SCALAR"}],)"
            R"("bufferViews":[{"buffer":0,"byteLength":)" +
            std::to_string(packed.size()) + R"(}],"buffers":[{"byteLength":)" +
            std::to_string(packed.size()) + "}]}",
        packed);
  }

  [[nodiscard]] Model parsed() const { return parse_model(bytes(), "a.glb"); }

  [[nodiscard]] std::string error() const { return error_text(bytes(), "a.glb"); }
};

class GltfDraco : public testing::TestWithParam<int> {};

TEST_P(GltfDraco, UnpacksTheMeshAndMovesItByItsNode) {
  DracoScene scene;
  scene.packed = draco_bytes(GetParam());
  const Model model = scene.parsed();
  ASSERT_EQ(model.mesh.positions.size(), 4U);
  ASSERT_EQ(model.mesh.triangles.size(), 4U);
  TriMesh local = model.mesh;
  for (Vec3& p : local.positions) {
    p.z() -= 10.0;
  }
  constexpr double kStep = 2.0 / 2047.0;  // 11 bits over an extent of 2
  EXPECT_NEAR(6.0 * signed_volume(local), 8.0, 4.0 * 6.0 * kStep);
}

INSTANTIATE_TEST_SUITE_P(Methods, GltfDraco,
                         testing::Values(draco::MESH_EDGEBREAKER_ENCODING,
                                         draco::MESH_SEQUENTIAL_ENCODING));

TEST(GltfDracoSkin, MovesThePackedVerticesWithTheirJoint) {
  const std::string packed = draco_bytes(draco::MESH_SEQUENTIAL_ENCODING, true);
  const Model model = parse_model(
      glb(R"({"asset":{"version":"2.0"},"extensionsRequired":["KHR_draco_mesh_compression"],)"
          R"("extensionsUsed":["KHR_draco_mesh_compression"],"scenes":[{"nodes":[0,1]}],)"
          R"("nodes":[{"mesh":0,"skin":0},{"translation":[0,0,50]}],"skins":[{"joints":[1]}],)"
          R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2},)"
          R"("indices":3,"extensions":{"KHR_draco_mesh_compression":{"bufferView":0,)"
          R"("attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2}}}}]}],)"
          R"("accessors":[{"componentType":5126,"count":4,"type":"VEC3"},)"
          R"({"componentType":5121,"count":4,"type":"VEC4"},)"
          R"({"componentType":5126,"count":4,"type":"VEC4"},)"
          R"({"componentType":5125,"count":12,"type":"SCALAR"}],)"
          R"("bufferViews":[{"buffer":0,"byteLength":)" +
              std::to_string(packed.size()) + R"(}],"buffers":[{"byteLength":)" +
              std::to_string(packed.size()) + "}]}",
          packed),
      "a.glb");
  ASSERT_EQ(model.mesh.positions.size(), 4U);
  for (const Vec3& p : model.mesh.positions) {
    EXPECT_GT(p.z(), 40.0);
  }
}

TEST(GltfDracoStrip, IsTrianglesOnceUnpacked) {
  DracoScene scene;
  scene.mode = "5";
  EXPECT_EQ(scene.parsed().mesh.triangles.size(), 4U);
}

TEST(GltfDracoError, NamesAnAttributeThatIsNotThere) {
  DracoScene scene;
  scene.id = "7";
  EXPECT_THAT(scene.error(), HasSubstr("lacks attribute 7"));
}

TEST(GltfDracoError, IsOneSentenceWhereverTheBytesAreCut) {
  const DracoScene whole;
  for (std::size_t size = 0; size < whole.packed.size(); ++size) {
    DracoScene cut;
    cut.packed = whole.packed.substr(0, size);
    EXPECT_THAT(cut.error(), HasSubstr("a primitive packed by KHR_draco_mesh_compression")) << size;
  }
}

TEST(GltfDracoError, NamesAnotherBitstream) {
  DracoScene scene;
  scene.packed[6] = 1;
  EXPECT_THAT(scene.error(), HasSubstr("bitstream version 2.1"));
}

TEST(DracoMesh, OfBillionsOfFacesIsRefusedBeforeThereIsRoomForThem) {
  // Header, method, then 2³¹ − 1 faces and as many points as numbers of 7 bits.
  const std::string many("\xFF\xFF\xFF\xFF\x07", 5);
  for (const char method : {'\0', '\1'}) {
    std::string bytes = std::string("DRACO\2\2\1", 8) + method + std::string(2, '\0');
    bytes += (method == '\1' ? std::string(1, '\0') : std::string()) + many + many;
    const DracoMesh mesh = unpack_draco(bytes, {}, 1'000'000);
    EXPECT_THAT(mesh.problem, HasSubstr("out of proportion")) << int{method};
  }
}

TEST(DracoMesh, OfACornerBeyondItsPointsIsDamaged) {
  std::string bytes = draco_bytes(draco::MESH_SEQUENTIAL_ENCODING);
  // Header of 11 bytes; faces, points, and 1 for corners as a plain list of bytes.
  ASSERT_EQ(bytes.substr(11, 3), "\4\4\1");
  ASSERT_EQ(unpack_draco(bytes, {}, 1'000'000).problem, "");
  bytes[14] = '\4';  // the first corner: there are points 0 to 3
  EXPECT_EQ(unpack_draco(bytes, {}, 1'000'000).problem, "is damaged");
}

}  // namespace
}  // namespace vantage::test
