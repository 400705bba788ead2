/**
 * Property tests make the same examples in every run, so that a change is judged by what it changes. Other examples:
 * `FAST_CHECK_SEED=7 npm test`.
 */
import fc from 'fast-check'

fc.configureGlobal({ ...fc.readConfigureGlobal(), seed: Number(process.env.FAST_CHECK_SEED ?? 20_261_122) })
