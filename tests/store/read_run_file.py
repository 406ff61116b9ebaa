"""A run file as a user of h5py meets it. Usage: read_run_file.py WRITER"""
import math
import os
import subprocess
import sys
import tempfile

try:
    import h5py
except ImportError:
    print("skipped: h5py is not installed")
    sys.exit(77)

with tempfile.TemporaryDirectory() as folder:
    name = os.path.join(folder, "run.h5")
    subprocess.run([sys.argv[1], name], check=True)
    with h5py.File(name, "r") as run:
        assert run.attrs["format"].decode() == "shakebed run"
        T_z = run["averages/T_z"][0]
        assert T_z["mean"] == 0.1 + 0.2 and T_z["standard_error"] == 1e-3
        assert run["averages/T_z"].attrs["unit"].decode() == "m g d"
        assert math.isnan(run["averages/T_z_scaled"][0]["standard_error"])
        assert run["scalars/k_n"][0] == 2e5
        assert run["series/base_power"].shape == (20000,)
        assert run["series/base_power"].attrs["cycles_per_entry"] == 16
        assert list(run["profiles/phi"]["mean"]) == [0.3, 0.1]
        assert run["provenance"].attrs["seed"] == 0xFEDCBA9876543210
        assert run["scene/canonical_yaml"][0].decode().startswith("scene: 1\n")
        assert [text.decode() for text in run["verdict/warnings"]][1] == "omega t_c is 0.22 rad"
        every = []
        run.visititems(lambda path, item: every.append(item))
        arrays = [item for item in every if isinstance(item, h5py.Dataset)]
        assert len(arrays) == 13 + (5 + 3) + (4 + 3)
        bed = run["snapshots/T10.05"]
        assert bed["position"].shape == (2, 3) and bed["position"][1, 1] == 4
        assert list(bed["id"]) == [0, 1] and bed.attrs["cycles"] == 10.05
        assert list(run["contacts/T10.05/j"]) == [1, -1]
        assert list(run["contacts/T10.05/normal_force"]) == [-0.25, 12]
        assert "spin" in bed and "spin" not in run["snapshots/T11"]
        for array in arrays:
            assert array.chunks is not None and array.fletcher32, array.name
