// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Hashes of contents, and files whose hashes are of the former method.
#include "io/content_hash.h"

#include <gtest/gtest.h>

#include "io/factors/factor_formats.h"
#include "io/runs/run_identity.h"
#include "support/refusal.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "transillum/files.h"

namespace transillum {
namespace content_hash_test {
namespace {

using Method = ContentHash::Method;
using test::refusal;

TEST(ContentHash, NamesItsMethod) {
  EXPECT_EQ(ContentHash().digits(), "xxh3-99aa06d3014798d86001c324468d497f");
  // The digest of nothing, d41d8cd9…, as former files have it: Boost reverses each word's bytes.
  EXPECT_EQ(ContentHash(Method::md5).digits(), "d98c1dd404b2008f980980e97e42f8ec");
  for (const Method method : {Method::xxh3, Method::md5}) {
    EXPECT_EQ(ContentHash::method_of(ContentHash(method).digits()), method);
  }
}

TEST(ContentHash, OfFormFactorsMayBeTheFormerOne) {
  const auto scene = load_scene("furnace");
  StoredFormFactors stored{"f.npz", {}, {}, {}};
  stored.form_factors.row_begin.assign(scene->patches().size() + 1, 0);
  for (const Patch& patch : scene->patches()) {
    stored.areas.push_back(patch.area);
  }
  stored.polygons = hash_of_polygons(*scene, Method::md5);
  EXPECT_NO_THROW(check_form_factors(*scene, stored));
  stored.polygons.back() = stored.polygons.back() == '0' ? '1' : '0';
  EXPECT_NE(refusal([&] { check_form_factors(*scene, stored); }).find("of other polygons"),
            std::string::npos);
}

TEST(ContentHash, OfRunsMayBeTheFormerOne) {
  const test::TemporaryFolder folder;
  const auto scene = load_scene("furnace");
  const RunIdentity identity = run_identity(*scene, {});
  const std::string path = folder.path() / "run";
  nlohmann::ordered_json former = identity.json;
  former["scene"] = identity.former_scene;
  const auto check = [&](const nlohmann::ordered_json& run) {
    write_sealed(path, "run", {{"run", run}}, [](std::ostream&) {});
    return refusal([&] { check_identity(SealedFile(path, "run"), identity); });
  };
  EXPECT_EQ(check(identity.json), "");
  EXPECT_EQ(check(former), "");
  former["scene"]["light"] = "0";
  EXPECT_NE(check(former).find("reflectances or exitances differ"), std::string::npos);
}

}  // namespace
}  // namespace content_hash_test
}  // namespace transillum
