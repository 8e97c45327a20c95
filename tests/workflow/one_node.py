"""A real Slurm of this one machine, without anything of the system's configuration: own key, own sockets, own ports, own
state, all below one folder and gone with it. Needs the packages slurm-wlm and munge, and no rights."""

import getpass
import os
import re
import secrets
import shutil
import socket
import subprocess
import time
from pathlib import Path

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "srun", "sinfo", "squeue", "scontrol")
SYSTEM_FOLDERS = "/usr/sbin:/usr/local/sbin:/sbin"

CONFIGURATION = """\
ClusterName=one
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
SwitchType=switch/none
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SchedulerType=sched/backfill
SchedulerParameters=batch_sched_delay=1,sched_interval=2,bf_interval=2
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
MinJobAge=3600
KillWait=5
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} RealMemory={memory} State=UNKNOWN
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def path():
    return f"{os.environ.get('PATH', '')}:{SYSTEM_FOLDERS}"


def missing():
    """The programs that are not installed."""
    return [name for name in PROGRAMS if shutil.which(name, path=path()) is None]


def free_ports(count):
    held = [socket.socket() for _ in range(count)]
    for one in held:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in held]
    for one in held:
        one.close()
    return ports


def free_memory():
    kib = int(re.search(r"^MemTotal:\s+(\d+)", Path("/proc/meminfo").read_text(encoding="ascii"), re.M).group(1))
    return max(500, kib // 1024 // 2)


class OneNode:
    """`with OneNode(folder) as slurm:`; commands run with slurm.environment use it."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.processes = []
        configuration = self.folder / "slurm.conf"
        self.environment = {**os.environ, "PATH": path(), "SLURM_CONF": str(configuration)}

    def __enter__(self):
        for name in ("state", "spool"):
            (self.folder / name).mkdir(parents=True)
        self.folder.chmod(0o755)
        key = self.folder / "munge.key"
        key.write_bytes(secrets.token_bytes(128))
        key.chmod(0o600)
        host = socket.gethostname().split(".")[0]
        (self.folder / "slurm.conf").write_text(
            CONFIGURATION.format(folder=self.folder, host=host, ports=free_ports(2), user=getpass.getuser(),
                                 cpus=os.cpu_count(), memory=free_memory()), encoding="ascii")
        try:
            self.start()
        except BaseException:
            self.__exit__()
            raise
        return self

    def start(self):
        munge = [f"--{name}={self.folder}/munge.{name.split('-')[0]}"
                 for name in ("key-file", "socket", "pid-file", "log-file", "seed-file")]
        self.spawn("munged", "--foreground", "--force", *munge)
        self.wait_for("munged", lambda: (self.folder / "munge.socket").exists())
        self.spawn("slurmctld", "-D", "-f", self.environment["SLURM_CONF"])
        self.spawn("slurmd", "-D", "-f", self.environment["SLURM_CONF"])
        self.wait_for("an idle node", lambda: self.ask("sinfo", "--noheader", "--format=%T") == "idle")

    def spawn(self, *command):
        with open(self.folder / f"{command[0]}.out", "ab") as out:
            self.processes.append(subprocess.Popen(command, env=self.environment, stdin=subprocess.DEVNULL, stdout=out,
                                                   stderr=subprocess.STDOUT, start_new_session=True))

    def ask(self, *command):
        return subprocess.run(command, env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                              check=False).stdout.strip()

    def wait_for(self, what, holds, seconds=60):
        end = time.monotonic() + seconds
        while not holds():
            if time.monotonic() > end or any(p.poll() is not None for p in self.processes):
                logs = "\n".join(f"--- {log.name}\n{log.read_text(errors='replace')[-2000:]}"
                                 for log in sorted(self.folder.glob("*.[lo][ou][gt]")))
                raise RuntimeError(f"Slurm has not come as far as {what}\n{logs}")
            time.sleep(0.2)

    def wait_for_jobs(self, seconds):
        """Until the queue is empty."""
        self.wait_for("an empty queue", lambda: self.ask("squeue", "--noheader", "--all") == "", seconds)

    def __exit__(self, *_):
        for process in reversed(self.processes):
            process.terminate()
            try:
                process.wait(20)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
