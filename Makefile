# Each line is a plain cargo command, for those without make. All targets except `lint` and `fuzz` share the release profile.

.PHONY: demo sample figures published-numbers test wheel test-python test-ray notebook recovery mistakes bench bench-ray lint fuzz

demo:
	cargo run --release --locked --bin fovqa -- run configs/demo.toml

# What is committed of the demo's results, and the pictures of the page in the documentation, for which Chromium is
# needed.
sample:
	cargo run --release --locked --bin fovqa -- run configs/demo.toml --output reports/sample
	FOVQA_WRITE_PICTURES=1 cargo test --release --locked --test integration browser::pictures

# The papers' experiments and curves, except those of data that is not in the repository. About 15 CPU minutes.
figures:
	for file in $$(grep -l '^\[\[scene\]\]' configs/papers/*.toml | xargs grep -L 'shared/data'); do \
	  cargo run --release --locked --bin fovqa -- run $$file --output reports/papers/$$(basename $$file .toml) || exit; \
	done
	cargo run --release --locked --bin fovqa -- curves $$(grep -L '^\[\[scene\]\]' configs/papers/*.toml) --output reports/papers
	cargo run --release --locked --bin fovqa -- report reports/papers

# docs/published-numbers.md, from the models and the papers' tables in ../shared/papers.
published-numbers:
	FOVQA_WRITE_PUBLISHED_NUMBERS=1 cargo test --release --locked --test integration published::

test:
	cargo test --release --locked

# The Python package, as target/wheels/fovqa-….whl.
python = target/python
wheel:
	test -x $(python)/build/bin/maturin || { python3 -m venv $(python)/build && $(python)/build/bin/pip install --quiet 'maturin>=1.9.4,<2'; }
	rm -rf target/wheels
	$(python)/build/bin/maturin build --release --locked --manifest-path crates/fovqa-py/Cargo.toml --out target/wheels

# Tests of the wheel in a new virtual environment.
test-python: wheel
	rm -rf $(python)/test && python3 -m venv $(python)/test
	$(python)/test/bin/pip install --quiet target/wheels/fovqa-*.whl --requirement crates/fovqa-py/tests/requirements.txt
	$(python)/test/bin/ruff check crates/fovqa-py && $(python)/test/bin/ruff format --check crates/fovqa-py
	$(python)/test/bin/python -m pytest crates/fovqa-py/tests

# Tests of fovqa.ray, with Ray from the Python registry. Its object store has 256 MiB.
test-ray: wheel
	rm -rf $(python)/ray && python3 -m venv $(python)/ray
	$(python)/ray/bin/pip install --quiet target/wheels/fovqa-*.whl --requirement crates/fovqa-py/tests/requirements.txt \
	  --requirement crates/fovqa-py/tests/requirements-ray.txt
	FOVQA_REQUIRE_RAY=1 $(python)/ray/bin/python -m pytest crates/fovqa-py/tests/test_ray.py

# docs/python.ipynb with its results.
notebook:
	FOVQA_WRITE_NOTEBOOK=1 $(MAKE) test-python

# How often the intervals of simulated studies contain the truth, as a table. About 5 CPU minutes.
recovery:
	cargo test --quiet --release --locked -p fovqa-study --test recovery -- --ignored --nocapture --test-threads=1

# Mistakes made on purpose in real renders, and how many of them are noticed, as a table. About 1 CPU minute.
mistakes:
	cargo test --quiet --release --locked -p fovqa-plausibility --test mistakes -- --nocapture

bench:
	cargo bench --locked -p fovqa-tests --bench speed

# The figures in docs/cluster.md, after `make test-ray`. About ten minutes.
bench-ray:
	$(python)/ray/bin/python crates/fovqa-py/benches/ray_units.py

# The Python module is linted without an interpreter.
lint: export PYO3_NO_PYTHON = 1
lint: export PYO3_BUILD_EXTENSION_MODULE = 1
lint:
	cargo fmt --all --check
	cargo clippy --release --locked --workspace --all-targets -- -D warnings

# Time for each fuzz target. tests/fuzz/README.md says what counts as a finding.
seconds = 200
fuzz:
	cd tests/fuzz && for target in $$(cargo fuzz list --fuzz-dir .); do \
	  mkdir -p corpus/$$target seeds/$$target && RUSTC_BOOTSTRAP=1 cargo fuzz run -O --fuzz-dir . $$target corpus/$$target seeds/$$target -- \
	    -max_total_time=$(seconds) -timeout=10 -rss_limit_mb=2048 -malloc_limit_mb=256 -print_final_stats=1 || exit; \
	done
