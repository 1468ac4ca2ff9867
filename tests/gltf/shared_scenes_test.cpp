// Scenes and broken files of the folder that CLVNDF_SCENES names, each with what must come of it.
#include <chrono>
#include <cstdlib>
#include <filesystem>

#include "error.h"
#include "gltf/load.h"
#include "sound.h"
#include "support/skip.h"

using namespace vndf;
using namespace vndf::test;

namespace {

std::filesystem::path scenes() {
    const char* const folder = std::getenv("CLVNDF_SCENES");
    return folder ? folder : "";
}

struct Valid {
    const char* file;
    std::size_t triangles, materials, textures, lights;
    bool camera;
    std::vector<const char*> warnings;  // in this order
};

// Materials and textures are those that are used.
const std::vector<Valid> valid{
    {"Triangle.gltf", 1, 1, 0, 0, false, {}},
    {"TriangleWithoutIndices.gltf", 1, 1, 0, 0, false, {}},
    {"Box/Box.gltf", 12, 1, 0, 0, false, {}},
    {"BoxInterleaved.glb", 12, 1, 0, 0, false, {}},
    {"SimpleSparseAccessor.gltf", 12, 1, 0, 0, false, {}},
    {"OrientationTest.glb", 524, 7, 0, 0, false, {}},
    {"VertexColorTest.glb", 36, 2, 2, 0, false, {}},
    {"MeshPrimitiveModes.gltf", 16, 1, 0, 0, false, {"points and lines"}},
    {"UnicodeNames/Unicode ❤♻ Test.gltf", 2, 1, 1, 0, false, {}},
    {"Cameras.gltf", 2, 1, 0, 0, true, {}},
    {"SimpleMeshes.gltf", 2, 1, 0, 0, false, {}},
    {"ManyCubes/many-cubes.gltf", 6012, 1, 0, 0, true, {}},
    {"SimpleInstancing.glb", 12, 1, 0, 0, false, {"'EXT_mesh_gpu_instancing'"}},
    {"MetalRoughSpheresNoTextures.glb", 1040409, 99, 0, 0, false, {"without an area"}},
    {"ShaderBall/shader_ball.gltf", 9450, 1, 0, 0, true, {}},
    {"NormalTangentMirrorTest.glb", 5240, 1, 3, 0, false, {}},
    {"AnisotropyStrengthTest.glb", 97240, 50, 1, 0, false, {}},
    {"ClearCoatTest.glb", 37116, 19, 10, 0, false, {"coat's normals"}},
    {"ClearCoatCarPaint.glb", 3072, 1, 1, 0, false, {}},
    {"TransmissionTest.glb", 128775, 14, 9, 0, true, {"'KHR_xmp'"}},
    {"EmissiveStrengthTest.glb", 90, 6, 1, 0, false, {}},
    {"UnlitTest.glb", 88, 2, 0, 0, false, {}},
    {"AllExtensionsSphere/sphere.gltf",
     224,
     1,
     7,
     0,
     false,
     {"'KHR_materials_sheen'", "thickness", "coat's normals"}},
    {"SheenOptional/19_sheen.gltf", 6720, 7, 0, 0, false, {"'KHR_materials_sheen'"}},
    {"TextureSettingsTest.glb", 72, 10, 9, 0, false, {}},
    {"TextureEncodingTest.glb", 3844, 14, 8, 0, false, {}},
    {"TextureTransformTest/TextureTransformTest.gltf", 24, 9, 5, 0, false, {}},
    {"LightsSphere/sphere_lights.gltf", 224, 1, 2, 4, false, {}},
    {"LitPlane.glb", 2, 1, 0, 2, false, {}},
    {"CornellBox.glb", 36, 5, 0, 0, false, {}},
    {"AnimatedMorphCube.glb", 12, 1, 0, 0, false, {"animations", "morph targets"}},
    {"Fox.glb", 576, 1, 1, 0, false, {"animations", "skins"}},
    {"RiggedSimple.glb", 188, 1, 0, 0, false, {"animations", "skins"}},
    {"ToyCar/ToyCar.gltf", 108936, 3, 7, 0, true, {"'KHR_materials_sheen'"}},
    {"GlassVaseFlowers.glb", 14036, 3, 3, 0, false, {"thickness"}},
    {"derived/SmallRoughnessSpheres.glb", 1040409, 99, 0, 0, false, {"without an area"}},
    {"derived/DispersionPrisms.gltf", 200, 25, 0, 0, true, {}},
};

struct Broken {
    const char* file;
    const char* error;    // a part of it; or else
    const char* warning;  // of one
};

const std::vector<Broken> broken{
    {"accessor-counts_wrong/Cube.gltf",
     "bufferViews[2]: 432 bytes from 504 on do not fit its buffer of 514 bytes", ""},
    {"accessor-small_stride.gltf", "accessors[0]: elements of 16 bytes overlap", ""},
    {"accessor-too_long.gltf", "accessors[0]: 4 elements of 12 bytes, 12 apart from byte 0 on, do not fit",
     ""},
    {"accessor-unresolved_view.gltf", "accessors[0].bufferView: there is no bufferView 99", ""},
    {"asset-version_1_0.gltf", "asset.version: '1.0' is not read", ""},
    {"buffer-data_uri_too_short.gltf", "buffers[0].byteLength: 2 bytes, where there are 1", ""},
    {"buffer-git_lfs_pointer/LightsPoint.gltf", "Git LFS", ""},
    {"buffer-missing_bin/BoxTextured.gltf", "buffers[0].uri: 'BoxTextured0.bin': there is no such file", ""},
    {"buffer_view-length_1e300/integer-out-of-bounds.gltf", "bufferViews[0].byteLength: 1e+300 is no whole",
     ""},
    {"buffer_view-too_long.gltf", "bufferViews[0]: 40 bytes from 29 on do not fit", ""},
    {"camera-orthographic_zero.gltf", "cameras[0].orthographic.ymag: 0 is out of range", ""},
    {"glb-empty_file.glb", "0 bytes, where the header of a GLB has 12", ""},
    {"glb-invalid_json_chunk.glb", "no JSON", ""},
    {"glb-invalid_magic.glb", "does not begin with glTF", ""},
    {"glb-no_bin_chunk.glb", "buffers[0]: has no uri", ""},
    {"image-bomb/plane.gltf", "images[0]: 65500 x 65500 pixels", ""},
    {"image-buffer_view_without_buffer/invalid-buffer-index.gltf",
     "bufferViews[1].buffer: there is no buffer 1", ""},
    {"image-uri_bad_percent.gltf", "asset.version: ''", ""},
    {"index-accessor_too_long.gltf", "accessors[0]: 4 elements of 4 bytes, 12 apart", ""},
    {"index-count_not_multiple_of_3.glb", "nothing to render", ""},
    {"index-out_of_range/IndexOutOfRange.gltf", "indices: index 255 at 0: the vertices are 24", ""},
    {"index-primitive_restart/Mesh_PrimitiveRestart_08.gltf", "index 255 at 2: the restart value", ""},
    {"index-signed.gltf", "indices: SCALAR of components 5122", ""},
    {"json-empty_file.gltf", "no JSON", ""},
    {"json-invalid_syntax.gltf", "no JSON", ""},
    {"light-spot_angles.gltf", "", "innerConeAngle 0.2 to 0.099"},
    {"material-out_of_range.gltf", "", "KHR_materials_ior.ior -0.5 to 1"},
    {"mesh-no_position/Mesh_NoPosition_01.gltf", "without POSITION", ""},
    {"mesh-position_format.gltf", "POSITION: VEC4", ""},
    {"mesh-unresolved_material.gltf", "material: there is no material 0", ""},
    {"mesh-unresolved_position.gltf", "POSITION: there is no accessor 99", ""},
    {"node-infinite_translation.gltf", "too large", ""},
    {"node-unresolved_mesh.gltf", "nodes[0].mesh: there is no mesh 0", ""},
    {"normals-zero.glb", "", "without a direction"},
    {"positions-infinite.glb", "no numbers or too far, dropped (12)", ""},
    {"required-draco/Box.gltf", "'KHR_draco_mesh_compression'", ""},
    {"required-iridescence.glb", "'KHR_materials_iridescence'", ""},
    {"required-meshopt.glb", "'EXT_meshopt_compression'", ""},
    {"required-unknown_extension.gltf", "'KHR_materials_pbrSpecularGlossiness', 'EXT_lights_image_based'",
     ""},
    {"scene-node_loop.gltf", "nodes[5].children[0]: node 4 has two parents", ""},
    {"scene-none.gltf", "there is no scene 0", ""},
    {"scene-unresolved_default.gltf", "there is no scene 0", ""},
    {"scene-unresolved_node.gltf", "there is no node 0", ""},
    {"sparse-count_too_big.gltf", "sparse.count: 4 is out of range", ""},
    {"sparse-indices_too_long.gltf", "sparse.indices: 2 elements of 2 bytes", ""},
    {"tangents-not_unit.gltf", "", "made unit vectors"},
};

// Every scene of a folder stands in its table.
template <class Row>
void require_complete(const std::filesystem::path& folder, const std::vector<Row>& rows) {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const std::string extension = entry.path().extension().string();
        count += extension == ".gltf" || extension == ".glb";
    }
    CHECK(count == rows.size());
}

}  // namespace

TEST_CASE("real scenes are read whole") {
    if (scenes().empty()) VNDF_SKIP("CLVNDF_SCENES names no folder");
#if !(CLVNDF_PNG && CLVNDF_JPEG)
    VNDF_SKIP("this build lacks libpng or libjpeg");
#endif
    require_complete(scenes() / "valid", valid);
    for (const Valid& expected : valid) {
        CAPTURE(expected.file);
        const gltf::Loaded loaded = gltf::load(scenes() / "valid" / expected.file, "");
        CHECK(loaded.triangles == expected.triangles);
        CHECK(loaded.scene.materials.size() == expected.materials);
        CHECK(loaded.scene.textures.size() == expected.textures);
        CHECK(loaded.scene.lights.size() == expected.lights);
        CHECK(loaded.has_camera == expected.camera);
        CHECK(unsound(loaded.scene) == "");
        REQUIRE(loaded.warnings.size() == expected.warnings.size());
        for (std::size_t i = 0; i < expected.warnings.size(); ++i)
            CHECK_THAT(loaded.warnings[i].first, Catch::Matchers::ContainsSubstring(expected.warnings[i]));
    }
}

TEST_CASE("broken files are refused in one line or shown with a warning") {
    if (scenes().empty()) VNDF_SKIP("CLVNDF_SCENES names no folder");
#if !(CLVNDF_PNG && CLVNDF_JPEG)
    VNDF_SKIP("this build lacks libpng or libjpeg");
#endif
    require_complete(scenes() / "broken", broken);
    for (const Broken& expected : broken) {
        CAPTURE(expected.file);
        const std::filesystem::path file = scenes() / "broken" / expected.file;
        std::string error, warnings;
        try {
            const gltf::Loaded loaded = gltf::load(file, "");
            CHECK(unsound(loaded.scene) == "");
            for (const auto& [what, count] : loaded.warnings) warnings += what + "\n";
        } catch (const InputError& refusal) {
            error = refusal.what();
        }
        CHECK(error.empty() == (expected.error[0] == '\0'));
        CHECK(error.find('\n') == error.npos);
        if (!error.empty()) CHECK(error.starts_with(file.string() + ": "));
        CHECK_THAT(error, Catch::Matchers::ContainsSubstring(expected.error));
        CHECK_THAT(warnings, Catch::Matchers::ContainsSubstring(expected.warning));
    }
}
