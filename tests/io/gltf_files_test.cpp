/// The real glTF files beside the project, in and out, and Khronos' validator over what we write.
// SPDX-License-Identifier: MIT
#include <cstdlib>

#include "tests/io/gltf_made.h"

using namespace meshreel;
using namespace meshreel::io;
using namespace meshreel::io::test;

namespace {

const std::string source = MESHREEL_SOURCE_DIR;
const std::string files = source + "/../shared/data/files/";

bool have_validator()
{
    return std::system(
               ("cd '" + source + "/tests/io' && node -e 'require(\"gltf-validator\")' >/dev/null 2>&1").c_str()) == 0;
}

/// Nothing where the validator finds no error, else what it said.
std::string complaint(const Folder& folder, const std::string& names)
{
    const std::string command = "cd '" + folder.path.string() + "' && node '" + source +
                                "/tests/io/gltf_validator.mjs' " + names + " >log 2>&1";
    return std::system(command.c_str()) == 0 ? "" : read(folder / "log");
}

struct Counts {
    const char* name;
    const char* clip;
    std::uint32_t vertices;
    std::size_t triangles, frames;

    friend std::ostream& operator<<(std::ostream& out, const Counts& of) { return out << of.name << ' ' << of.clip; }
};

} // namespace

class GltfFile : public testing::TestWithParam<Counts> {};

TEST_P(GltfFile, IsReadWithItsCountsAndGoesOutAsItCameIn)
{
    const Counts expected = GetParam();
    if (!std::filesystem::exists(files + expected.name)) GTEST_SKIP() << "no data beside the project";
    LoadOptions options;
    options.clip = expected.clip;
    const auto once = load(files + expected.name, options);
    ASSERT_TRUE(once.ok()) << why(once);
    EXPECT_EQ(once->vertex_count, expected.vertices);
    EXPECT_EQ(once->triangles.size(), expected.triangles);
    EXPECT_EQ(once->frame_count(), expected.frames);
    const Folder folder;
    ASSERT_TRUE(save(*once, folder / "back.glb").ok());
    const auto twice = load(folder / "back.glb");
    ASSERT_TRUE(twice.ok()) << why(twice);
    EXPECT_EQ(twice->triangles, once->triangles);
    EXPECT_EQ(twice->meta.name, once->meta.name);
    double largest = 0;
    for (std::size_t i = 0; i < once->positions.size(); ++i)
        largest = std::max(largest, std::abs(double(once->positions[i]) - twice->positions[i]));
    EXPECT_LT(largest, 1e-7 * body_diagonal(*once));
    ASSERT_EQ(twice->appearance.assets.size(), once->appearance.assets.size());
    for (std::size_t i = 0; i < once->appearance.assets.size(); ++i)
        EXPECT_EQ(twice->appearance.assets[i].bytes, once->appearance.assets[i].bytes);
    for (const Attribute& attribute : once->appearance.attributes)
        EXPECT_EQ(twice->appearance.find(attribute.name)->values, attribute.values) << attribute.name;
}

INSTANTIATE_TEST_SUITE_P(
    Data, GltfFile,
    testing::Values(Counts{"CesiumMan.glb", "", 3273, 4672, 48}, Counts{"Fox.glb", "Survey", 1728, 576, 83},
                    Counts{"Fox.glb", "Walk", 1728, 576, 18}, Counts{"Fox.glb", "Run", 1728, 576, 35},
                    Counts{"RobotExpressive.glb", "Dance", 7214, 3237, 81},
                    Counts{"RobotExpressive.glb", "Punch", 7214, 3237, 21},
                    Counts{"lumberjack.glb", "Walk", 3068, 1538, 31}, Counts{"lumberjack.glb", "A-pose", 3068, 1538, 1},
                    Counts{"MorphStressTest.gltf", "Pulse", 1528, 2412, 153}));

TEST_P(GltfFile, ComesOutWithoutAnErrorOfTheValidator)
{
    if (!have_validator()) GTEST_SKIP() << "no node with gltf-validator";
    if (!std::filesystem::exists(files + GetParam().name)) GTEST_SKIP() << "no data beside the project";
    LoadOptions options;
    options.clip = GetParam().clip;
    const auto read = load(files + GetParam().name, options);
    ASSERT_TRUE(read.ok()) << why(read);
    const Folder folder;
    SaveOptions save_options;
    ASSERT_TRUE(save(*read, folder / "frames.glb", save_options).ok());
    save_options.morphs = Morphs::pca;
    ASSERT_TRUE(save(*read, folder / "modes.gltf", save_options).ok());
    EXPECT_EQ(complaint(folder, "frames.glb modes.gltf"), "");
}

TEST(GltfValidator, AcceptsWhatOtherFormatsBring)
{
    if (!have_validator()) GTEST_SKIP() << "no node with gltf-validator";
    const Folder folder;
    write(folder / "in.obj",
          "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 5 5 5\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 3\n"
          "g left\nusemtl red\nf 1/1/1 2/2/1 3/3/1\ng right\nusemtl blue\nf 2/1/1 4/2/1 3/3/1\n");
    const auto read = load(folder / "in.obj");
    ASSERT_TRUE(read.ok()) << why(read);
    ASSERT_TRUE(save(*read, folder / "obj.glb").ok());
    ASSERT_TRUE(save(tetrahedron(9), folder / "frames.glb").ok());
    EXPECT_EQ(complaint(folder, "obj.glb frames.glb"), "");
}
