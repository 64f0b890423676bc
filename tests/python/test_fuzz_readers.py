"""A short run of studies/fuzz_readers.py, which is run by hand with 200,000 files."""

from studies import fuzz_readers


def test_damaged_files_of_every_kind_are_read_or_refused_by_name(tmp_path):
    assert fuzz_readers.fuzz(tmp_path, 2000, 7) == 0, sorted(path.name for path in (tmp_path / "faults").iterdir())


def test_the_same_seed_alters_alike_and_a_fault_is_kept(tmp_path, monkeypatch):
    def fail(name, path, mesh):
        raise KeyError(name)

    monkeypatch.setattr(fuzz_readers, "read", fail)
    counts = [fuzz_readers.fuzz(tmp_path / folder, 20, 3) for folder in "ab"]
    kept = [
        {path.name: path.read_bytes() for path in (tmp_path / folder / "faults").iterdir() if path.suffix != ".fault"}
        for folder in "ab"
    ]
    assert counts == [20, 20] and kept[0] == kept[1]
