//! The same bits by all instructions, and any sample by itself.

use twoforms_estimator::numbers::Numbers;
use twoforms_estimator::sampler::{ROW, Row, Sampler};
use twoforms_estimator::xi::Key;
use twoforms_geometry::lanes::Instructions;

use super::points::{stream, words, words_by};

/// Pairs that a sample takes: beyond the dimensions of `halton`.
const PAIRS: usize = 10;

#[test]
fn bits_do_not_depend_on_the_instructions() {
    for &sampler in Sampler::ALL {
        for n in [1, 5, 64, 1000] {
            let stream = stream(sampler, sampler.rounded(n), 21, 3);
            let scalar = words_by(Instructions::SCALAR, &stream, PAIRS);
            for instructions in Instructions::all() {
                assert_eq!(words_by(instructions, &stream, PAIRS), scalar, "{sampler}, {instructions:?}");
            }
        }
    }
}

#[test]
fn any_sample_can_be_asked_for_by_itself() {
    for &sampler in Sampler::ALL {
        let stream = stream(sampler, sampler.rounded(300), 22, 1);
        let all = words(&stream, PAIRS);
        for index in [0, 1, 17, 128, 299] {
            assert_eq!(stream.xi(index, PAIRS).words(0), all[index as usize], "{sampler}, sample {index}");
        }
    }
}

/// Samples of many streams side by side are those of each stream.
#[test]
fn rows_hold_the_samples_of_their_streams() {
    const FIRST: u32 = 20;
    const LENGTH: usize = 3;
    for &sampler in Sampler::ALL {
        let n = sampler.rounded(64);
        let streams = std::array::from_fn(|k| 100 + k as u32);
        let row = Row { key: Key::new([23]), n, streams: [[n; ROW], streams], first: [FIRST; ROW] };
        for instructions in Instructions::all() {
            let mut numbers = Numbers::new(PAIRS);
            row.fill(sampler, instructions, LENGTH, &mut numbers);
            for k in 0..ROW {
                let alone = words(&stream(sampler, n, 23, streams[k]), PAIRS);
                for i in 0..LENGTH {
                    assert_eq!(numbers.words(i * ROW + k), alone[FIRST as usize + i], "{sampler}, {k}, {i}");
                }
            }
        }
    }
}
