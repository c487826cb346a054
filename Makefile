# Each line is plain cargo, for those without make. Everything but `lint` shares the release profile.

.PHONY: demo test bench lint

demo:
	cargo run --release --locked --bin fovqa -- run configs/demo.toml

test:
	cargo test --release --locked --workspace

bench:
	cargo bench --locked -p fovqa-tests --bench speed

lint:
	cargo fmt --all --check
	cargo clippy --release --locked --workspace --all-targets -- -D warnings
