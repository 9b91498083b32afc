// The scripts among files that others made, and in folders of any name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>
#include <vector>

#include "tests/support/child_process.hpp"
#include "tests/support/domain_reservation.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using namespace std::chrono_literals;

const std::string kScripts = source_folder() + "/launch_scripts/";
const std::string kBin = build_folder() + "/bin";

class ForeignFiles : public testing::Test {
 protected:
  /// In bash, with fail, as the scripts call it.
  [[nodiscard]] int run_locks(const std::string& commands) {
    ChildProcess bash({"/bin/bash", "-c",
                       "fail() { echo \"fail: $1\"; exit 2; }; source '" + kScripts +
                           "domain_locks.sh'; " + commands},
                      folder_ / "output");
    return bash.wait_for(60s).value_or(-1);
  }
  [[nodiscard]] std::string output() const { return read_text(folder_ / "output"); }
  [[nodiscard]] std::string path() const { return folder_.path().string(); }

  const TemporaryFolder folder_;
};

struct RuntimeFolder {
  std::string name;
  std::string make;  ///< commands that make $1
  bool is_used;
};
void PrintTo(const RuntimeFolder& one, std::ostream* out) { *out << one.name; }

class RuntimeFolders : public ForeignFiles, public testing::WithParamInterface<RuntimeFolder> {};

// Somebody else has the user's folder in /tmp.
TEST_P(RuntimeFolders, AreUsedOnlyIfNobodyElseCanWriteThere) {
  const std::string runtime = path() + "/runtime";
  const int code = run_locks(
      "lock_root='" + path() + "'; : >\"$lock_root/hlc-$EUID\"; set -- '" + runtime + "'; " +
      GetParam().make + "; XDG_RUNTIME_DIR=$1; lock_domain 1 --exclusive && echo \"$lock_folder\"");
  EXPECT_EQ(code, GetParam().is_used ? 0 : 2);
  EXPECT_EQ(output() == runtime + "\n", GetParam().is_used) << output();
}

TEST_F(ForeignFiles, TheFolderForLocksDoesNotDependOnTheShell) {
  const std::string own = path() + "/hlc-" + std::to_string(geteuid());
  ASSERT_EQ(run_locks("lock_root='" + path() + "'; mkdir -m 700 '" + path() +
                      "/runtime'; XDG_RUNTIME_DIR='" + path() +
                      "/runtime'; lock_domain 1 --exclusive && echo \"$lock_folder\""),
            0)
      << output();
  EXPECT_EQ(output(), own + "\n");
  struct stat status {};
  ASSERT_EQ(lstat(own.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode, S_IFDIR | 0700U);
}

INSTANTIATE_TEST_SUITE_P(
    Scripts, RuntimeFolders,
    testing::Values(RuntimeFolder{"Private", "mkdir -m 700 \"$1\"", true},
                    RuntimeFolder{"Absent", ":", false},
                    RuntimeFolder{"OpenToOthers", "mkdir -m 755 \"$1\"", false},
                    RuntimeFolder{"Link", "mkdir -m 700 \"$1.to\"; ln -s \"$1.to\" \"$1\"", false},
                    RuntimeFolder{"File", ": >\"$1\"", false}),
    [](const auto& one) { return one.param.name; });

struct InTmp {
  std::string name;
  std::string make;  ///< commands in an empty /tmp
  int exit_code;
};
void PrintTo(const InTmp& one, std::ostream* out) { *out << one.name; }

class FilesInTmp : public ForeignFiles, public testing::WithParamInterface<InTmp> {};

// Locks were files in /tmp: a pipe there stopped the script, a lock of another user kept everybody
// off, and root created what a link there pointed to.
TEST_P(FilesInTmp, NeitherStopTheScriptNorAreFollowed) {
  if (geteuid() != 0 || kBin.starts_with("/tmp")) GTEST_SKIP() << "needs a /tmp of its own: root";
  const DomainReservation domains{2};
  const std::string domain = std::to_string(domains.first());
  ChildProcess run(
      {"/usr/bin/unshare", "--mount", "/bin/bash", "-c",
       "mount -t tmpfs -o mode=1777 tmpfs /tmp && unset XDG_RUNTIME_DIR; cd /tmp && "
       "lock=hlc_dds_domain_" +
           domain + ".lock; " + GetParam().make + "; timeout 60 '" + kScripts +
           "run_lab.sh' --bin '" + kBin +
           "' --scenario paper_red_alone --steps 5 --startup_timeout_s 30 --dds_domain " + domain +
           " --out /tmp/run; code=$?; [[ ! -e /tmp/target ]] || echo THE_LINK_WAS_FOLLOWED; exit "
           "$code"},
      folder_ / "output");
  EXPECT_EQ(run.wait_for(120s), GetParam().exit_code) << output();
  EXPECT_THAT(output(), testing::Not(HasSubstr("THE_LINK_WAS_FOLLOWED")));
  if (GetParam().exit_code == 2) {
    EXPECT_THAT(output(), HasSubstr("run_lab.sh: /tmp/hlc-0: must be a folder of this user"));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Scripts, FilesInTmp,
    testing::Values(
        InTmp{"Pipe", "mkfifo -m 666 $lock", 0},
        InTmp{"DanglingLink", "ln -s /tmp/target $lock", 0},
        InTmp{"LockOfAnother", "install -m 666 /dev/null $lock; exec 9<>$lock && flock 9", 0},
        InTmp{"FolderOfAnother", "install -d -m 700 -o nobody hlc-0", 2},
        InTmp{"LinkInsteadOfAFolder", "install -d -m 700 target2; ln -s target2 hlc-0", 2}),
    [](const auto& one) { return one.param.name; });

TEST_F(ForeignFiles, ALockIsTakenByOneProcessAtATime) {
  const DomainReservation domain;
  const std::string lock = "lock_domain " + std::to_string(domain.first());
  EXPECT_EQ(run_locks(lock + " --exclusive"), 1) << "the test has it";
  EXPECT_EQ(run_locks(lock + " --shared"), 1);
  EXPECT_EQ(run_locks("lock_root='" + path() +
                      "'; lock_domain 1 --exclusive && (lock_domain 1 --shared || exit 7)"),
            7);
}

// Who has no lock has a port.
TEST_F(ForeignFiles, AParticipantOnTheDomainIsSeen) {
  const DomainReservation domain;
  const std::string number = std::to_string(domain.first());
  EXPECT_EQ(run_locks("domain_has " + number + " anybody"), 1);
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(7400 + 250 * domain.first()));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  EXPECT_EQ(run_locks("domain_has " + number + " anybody"), 0);
  EXPECT_EQ(run_locks("domain_has " + number + " others"), 1) << "it is of this user";
  EXPECT_EQ(run_locks("udp_sockets[1]=/absent; domain_has " + number + " anybody"), 0)
      << "without IPv6";
  EXPECT_TRUE(has_participant(domain.first()));
  ::close(socket);
}

TEST_F(ForeignFiles, NoProgramThatARunFolderNamesIsRun) {
  const fs::path evil = folder_ / "evil";
  fs::create_directories(evil);
  fs::create_directories(folder_ / "run" / "logs");
  for (const char* program :
       {"vehicle_sim", "middleware", "high_level_controller", "show_scenario"}) {
    std::ofstream(evil / program) << "#!/bin/sh\n: >" << path() << "/was_run\nexit 2\n";
    fs::permissions(evil / program, fs::perms::owner_all);
  }
  const DomainReservation domains{2};
  const std::vector<std::string> kept{"--vehicle_ids=1", "--scenario=paper_red_alone",
                                      "--bin=" + evil.string(), "--startup_timeout_s=1",
                                      "--dds_domain=" + std::to_string(domains.first())};
  for (const char separator : {'\0', '\n'}) {
    std::ofstream flags(folder_ / "run" / "logs" / "vehicle_1.flags");
    for (const std::string& flag : kept) flags << flag << separator;
    flags.close();
    ChildProcess vehicle({kScripts + "vehicle.sh", "--vehicle_ids", "1", "--only", "vehicle",
                          "--out", (folder_ / "run").string()},
                         folder_ / "output");
    EXPECT_NE(vehicle.wait_for(60s).value_or(0), 0) << output();
    EXPECT_FALSE(fs::exists(folder_ / "was_run"));
  }
}

struct Name {
  std::string name;
  std::string folder;
};
void PrintTo(const Name& one, std::ostream* out) { *out << one.name; }

class FolderNames : public ForeignFiles, public testing::WithParamInterface<Name> {};

TEST_P(FolderNames, AreAllAllowedForARun) {
  const fs::path work = folder_ / GetParam().folder;
  fs::create_directory(work);
  const std::string command =
      "cd -- \"$1\" && exec \"$2\" --bin \"$3\" --out \"$4\" --dump_problems \"$4/problems\" "
      "--scenario paper_red_alone --steps 5 --startup_timeout_s 30";
  ChildProcess run({"/bin/bash", "-c", command, "bash", work.string(), kScripts + "run_lab.sh",
                    kBin, GetParam().folder},
                   folder_ / "output");
  ASSERT_EQ(run.wait_for(120s), 0) << output();
  const fs::path out = work / GetParam().folder;
  for (const char* file : {"summary.json", "run.html", "run.mcap", "logs/vehicle_1.flags",
                           "problems", "configuration/flags.yaml"}) {
    EXPECT_TRUE(fs::exists(out / file)) << file << "\n" << output();
  }
}

INSTANTIATE_TEST_SUITE_P(Scripts, FolderNames,
                         testing::Values(Name{"Blanks", " two  blanks "}, Name{"Quotes", "a'b\"c"},
                                         Name{"Dash", "-rf"}, Name{"NewLine", "two\nlines\n"},
                                         Name{"Special", "$HOME;*`id`\\"}),
                         [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace hlc::test
