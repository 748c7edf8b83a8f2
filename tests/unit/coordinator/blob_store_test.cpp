#include "coordinator/blob_store.h"

#include <algorithm>
#include <filesystem>
#include <span>
#include <string_view>

#include <gtest/gtest.h>

namespace radfarm {
namespace {

std::span<const std::byte> bytes_of(std::string_view text) { return std::as_bytes(std::span(text)); }

class BlobStoreTest : public testing::Test {
 protected:
  std::size_t files_in_uploads() const {
    std::size_t count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder_.path() / "uploads")) ++count;
    return count;
  }
  TemporaryDirectory folder_ = *TemporaryDirectory::create("blob-store-test");
  BlobStore store_ = *BlobStore::open(folder_.path(), 1000);
};

TEST_F(BlobStoreTest, ReturnsWhatWasPut) {
  const BlobRef blob = *store_.put(bytes_of("light"));
  EXPECT_EQ(blob, (BlobRef{sha256_hex("light"), 5}));
  EXPECT_TRUE(store_.contains(blob.digest));
  const MappedFile file = *store_.read(blob.digest);
  EXPECT_TRUE(std::ranges::equal(file.bytes(), bytes_of("light")));
  EXPECT_EQ(*store_.put(bytes_of("light")), blob) << "again is fine";
  EXPECT_EQ(store_.read(sha256_hex("dark")).error().code, Code::kNotFound);
}

TEST_F(BlobStoreTest, EmptyBlobIsABlob) {
  const BlobRef blob = *store_.put({});
  EXPECT_TRUE(store_.read(blob.digest)->bytes().empty());
}

TEST_F(BlobStoreTest, NamesThatAreNoDigestsNeverReachTheDisk) {
  for (const std::string& name : {std::string("../../etc/passwd"), std::string("/etc/passwd"), std::string(),
                                  std::string(64, 'G'), std::string(63, 'a'), std::string(64, '/')}) {
    EXPECT_FALSE(store_.contains(name));
    EXPECT_EQ(store_.read(name).error().code, Code::kInvalidArgument);
    EXPECT_EQ(store_.begin({name, 1}).error().code, Code::kInvalidArgument);
  }
}

TEST_F(BlobStoreTest, RefusesBytesThatAreNotThosePromised) {
  const std::string digest = sha256_hex("light");
  {
    const auto upload = *store_.begin({digest, 5});
    ASSERT_TRUE(upload->append(bytes_of("night")));
    EXPECT_EQ(upload->commit().error().code, Code::kDataLoss);
  }
  {
    const auto upload = *store_.begin({digest, 5});
    EXPECT_EQ(upload->append(bytes_of("lights")).error().code, Code::kDataLoss);
  }
  {
    const auto upload = *store_.begin({digest, 5});
    ASSERT_TRUE(upload->append(bytes_of("ligh")));
    EXPECT_EQ(upload->commit().error().code, Code::kDataLoss);
  }
  EXPECT_FALSE(store_.contains(digest));
  EXPECT_EQ(files_in_uploads(), 0U) << "nothing is left behind";
}

TEST_F(BlobStoreTest, RefusesBlobsOverTheLimit) {
  EXPECT_EQ(store_.begin({sha256_hex("x"), 1001}).error().code, Code::kResourceExhausted);
}

TEST_F(BlobStoreTest, LinksIntoOtherFolders) {
  const BlobRef blob = *store_.put(bytes_of("light"));
  const std::filesystem::path target = folder_.path() / "scene.bin";
  ASSERT_TRUE(store_.link_to(blob.digest, target));
  EXPECT_EQ(*read_file(target, 100), "light");
  EXPECT_FALSE(store_.link_to(blob.digest, target)) << "exists";
}

}  // namespace
}  // namespace radfarm
