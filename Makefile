# Each line is plain cargo, for those without make. Everything but `lint` shares the release profile.

.PHONY: demo figures test bench lint

demo:
	cargo run --release --locked --bin fovqa -- run configs/demo.toml

figures:
	for figure in 4 10 12; do \
	  cargo run --release --locked --bin fovqa -- run configs/papers/patney-fig-$$figure.toml --output reports/papers/patney-fig-$$figure || exit; \
	done
	cargo run --release --locked --bin fovqa -- curves configs/papers/vafr-*.toml configs/papers/rmfr-*.toml configs/papers/deamp-*.toml configs/papers/patney-rates.toml --output reports/papers
	cargo run --release --locked --bin fovqa -- report reports/papers

test:
	cargo test --release --locked --workspace

bench:
	cargo bench --locked -p fovqa-tests --bench speed

lint:
	cargo fmt --all --check
	cargo clippy --release --locked --workspace --all-targets -- -D warnings
