#include "rpc/wire.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/digest.h"
#include "rpc/limits.h"

namespace radfarm::wire {
namespace {

using testing::HasSubstr;

const std::string kDigest = sha256_hex("a");

JobSpec small_spec() { return {"room", {{"a/room.gltf", {kDigest, 7}}}, "a/room.gltf", "{}"}; }

TEST(Wire, JobSpecComesBack) {
  v1::RenderJobSpec message;
  encode(small_spec(), message);
  const Result<JobSpec> back = parse(message);
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(*back, small_spec());
}

TEST(Wire, RefusesPathsThatLeaveTheJobsFolder) {
  const std::string long_path(limits::kPathBytes + 1, 'a');
  for (const std::string& path : {std::string(), std::string("/etc/passwd"), std::string(".."), std::string("../x"),
                                  std::string("a/../../x"), std::string("a//b"), std::string("a/"), std::string("./a"),
                                  std::string("a\\b"), std::string("a\nb"), std::string("a\0b", 3), long_path}) {
    EXPECT_FALSE(check_relative_path(path)) << path;
  }
  for (const char* path : {"a", "a/b.bin", "..a", "a..b/c", ".hidden", "ä/ö.png"}) {
    EXPECT_TRUE(check_relative_path(path)) << path;
  }
}

TEST(Wire, NamesTheFieldThatIsWrong) {
  const auto message_of = [](const JobSpec& spec) {
    v1::RenderJobSpec message;
    encode(spec, message);
    const Result<JobSpec> parsed = parse(message);
    return parsed ? std::string("accepted") : parsed.error().message;
  };
  JobSpec spec = small_spec();
  spec.files[0].blob.digest = "../../etc/passwd";
  EXPECT_THAT(message_of(spec), HasSubstr("spec.files.digest"));
  spec = small_spec();
  spec.entry_path = "other.gltf";
  EXPECT_THAT(message_of(spec), HasSubstr("spec.entry_path"));
  spec = small_spec();
  spec.files.push_back(spec.files[0]);
  EXPECT_THAT(message_of(spec), HasSubstr("given twice"));
  spec = small_spec();
  spec.files.clear();
  EXPECT_THAT(message_of(spec), HasSubstr("spec.files"));
  spec = small_spec();
  spec.files[0].blob.size = ~std::uint64_t{0};
  EXPECT_THAT(message_of(spec), HasSubstr("bytes in all"));
}

TEST(Wire, NamesAreShortPrintableUtf8) {
  const auto refusal = [](const std::string& name) {
    v1::RenderJobSpec message;
    encode(small_spec(), message);
    message.set_display_name(name);
    const Result<JobSpec> parsed = parse(message);
    EXPECT_TRUE(parsed || parsed.error().code == Code::kInvalidArgument);
    return parsed ? std::string("accepted") : parsed.error().message;
  };
  EXPECT_EQ(refusal(""), "accepted");
  EXPECT_EQ(refusal("Küche 厨房 🏠"), "accepted");
  EXPECT_EQ(refusal(std::string(limits::kNameBytes, 'a')), "accepted");
  EXPECT_THAT(refusal(std::string(limits::kNameBytes + 1, 'a')), HasSubstr("spec.display_name: has 201 bytes"));
  for (const std::string& name : {std::string("a\nb"), std::string("\x1b[2J"), std::string("a\0b", 3),
                                  std::string("a\x7f"), std::string("\xc2\x9b" "2J")}) {
    EXPECT_EQ(refusal(name), "spec.display_name: has control characters");
  }
  EXPECT_EQ(refusal("K\xfc" "che"), "spec.display_name: is not UTF-8");
}

TEST(Wire, WorkerNamesArePrintableUtf8) {
  v1::RegisterWorkerRequest message;
  encode(WorkerHello{"host/1", "build", "fingerprint", 1}, message);
  EXPECT_TRUE(parse(message));
  message.set_name("host\n1");
  EXPECT_FALSE(parse(message));
}

TEST(Wire, JobStatusComesBack) {
  JobStatus status{"id1", "room", JobState::kFailed, 9, 1700000000, {10, 4, 2, 3, 1, 0, "no worker", {"radiosity: links", 7, 1ULL << 40U}, 2},
                   {}, {}, true, {{"1 %", 1.5, 20}}, 7.25};
  status.failure = {JobFailure::Reason::kTaskFailed, {Code::kDataLoss, "task 3: damaged"}};
  status.artifacts = {{"image.exr", {kDigest, 5}}};
  v1::RenderJob message;
  encode(status, message);
  const Result<JobStatus> back = parse(message);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->state, JobState::kFailed);
  EXPECT_EQ(back->progress, status.progress);
  EXPECT_EQ(back->failure, status.failure);
  EXPECT_TRUE(back->target_missed);
  EXPECT_EQ(back->estimates, status.estimates);
  EXPECT_EQ(back->cpu_seconds, 7.25);
  EXPECT_EQ(back->artifacts, status.artifacts);
  EXPECT_EQ(back->created_unix_seconds, status.created_unix_seconds);
}

TEST(Wire, StatesAndReasonsHaveTheProtocolsNames) {
  EXPECT_EQ(to_string(JobState::kAssembling), "ASSEMBLING");
  EXPECT_EQ(to_string(JobState::kCancelled), "CANCELLED");
  EXPECT_EQ(to_string(JobFailure::Reason::kSceneInvalid), "SCENE_INVALID");
  EXPECT_EQ(to_string(JobFailure::Reason::kInternal), "INTERNAL");
}

TEST(Wire, LeaseComesBackWithAndWithoutSolution) {
  for (const std::string& solution : {std::string(), kDigest}) {
    const Lease lease{"job", 4, {Task::Kind::kAudit, 2}, {kDigest, solution, kDigest}, 3, "token", {2, 1024, 64, 1.25}, solution};
    v1::Lease message;
    encode(lease, message);
    const Result<Lease> back = parse(message);
    ASSERT_TRUE(back);
    EXPECT_EQ(*back, lease);
  }
}

TEST(Wire, RefusesResultsAboveTheLimit) {
  v1::CommitTaskRequest::Header header;
  header.set_digest(kDigest);
  header.set_size(limits::kResultBytes + 1);
  EXPECT_EQ(parse(header).error().code, Code::kResourceExhausted);
}

TEST(Wire, RefusesWorkersThatSayNothingOfThemselves) {
  WorkerHello hello{"w", "build", "print", 4, 1};
  v1::RegisterWorkerRequest message;
  encode(hello, message);
  EXPECT_TRUE(parse(message));
  message.set_threads(0);
  EXPECT_FALSE(parse(message));
  message.set_threads(1);
  message.clear_fingerprint();
  EXPECT_FALSE(parse(message));
}

}  // namespace
}  // namespace radfarm::wire
