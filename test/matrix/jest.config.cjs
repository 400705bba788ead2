const { join } = require('node:path')

/** Only for scripts/matrix.mjs, which installs what these tests run in. @type {import('jest').Config} */
module.exports = {
  ...require('../../jest.config.cjs'),
  rootDir: join(__dirname, '..', '..'),
  testMatch: ['<rootDir>/test/matrix/*.matrix.ts'],
  maxWorkers: 1,
  testTimeout: 60_000,
  verbose: true,
}
