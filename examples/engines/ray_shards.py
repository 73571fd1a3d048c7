# One collection in shards under Ray: python ray_shards.py MODELS RESULTS N
import subprocess
import sys

import ray

models, results, shards = sys.argv[1], sys.argv[2], int(sys.argv[3])


# Exit codes 1 to 3 would come again; every other end (75, a lost node) is worth another try.
@ray.remote(num_cpus=1, max_retries=3, retry_exceptions=[ConnectionError])
def run(shard):
    code = subprocess.run(
        ["vantage", "batch", models, "-o", results, "--shard", f"{shard}/{shards}", "--jobs", "1", "--quiet"],
        check=False).returncode
    if code not in (0, 1, 2, 3, 4):
        raise ConnectionError(f"shard {shard} ended with {code}")
    return code


ray.init()
codes = ray.get([run.remote(shard) for shard in range(shards)])
subprocess.run(["vantage", "results", "merge", results], check=True)
sys.exit(max((code for code in codes if code in (1, 2, 3)), default=max(codes)))  # broken goes before 4
